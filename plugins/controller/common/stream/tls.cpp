// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/tls.hpp"

#include <openssl/err.h>
#include <openssl/ssl.h>

#include <algorithm>
#include <climits>
#include <utility>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::stream {

namespace {

std::string reason_of_openssl() {
  const unsigned long code = ERR_peek_last_error();
  const char* const reason = code != 0 ? ERR_reason_error_string(code) : nullptr;
  ERR_clear_error();
  return reason ? reason : "for no reason that OpenSSL gives";
}

/// Refuses: a simulation asks for no passphrase on its terminal.
int no_passphrase(char*, int, int, void*) { return 0; }

int bounded(std::size_t size) { return int(std::min(size, std::size_t(INT_MAX))); }

}  // namespace

class TlsSession::Impl {
 public:
  explicit Impl(SSL_CTX* context) : ssl(SSL_new(context)) {
    SSL_set_bio(ssl, BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
    SSL_set_accept_state(ssl);
  }
  ~Impl() { SSL_free(ssl); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  SSL* const ssl;
  bool has_ended = false, has_failed = false, has_said_end = false;
};

TlsSession::TlsSession(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TlsSession::~TlsSession() = default;

void TlsSession::take_in(std::string_view encrypted) {
  BIO_write(SSL_get_rbio(impl_->ssl), encrypted.data(), bounded(encrypted.size()));
}

std::size_t TlsSession::read(char* to, std::size_t most) {
  if (impl_->has_failed || impl_->has_ended) return 0;
  ERR_clear_error();
  const int size = SSL_read(impl_->ssl, to, bounded(most));
  if (size > 0) return std::size_t(size);
  const int error = SSL_get_error(impl_->ssl, size);
  impl_->has_ended = error == SSL_ERROR_ZERO_RETURN;
  impl_->has_failed = !impl_->has_ended && error != SSL_ERROR_WANT_READ;
  ERR_clear_error();
  return 0;
}

bool TlsSession::has_ended() const { return impl_->has_ended; }
bool TlsSession::has_failed() const { return impl_->has_failed; }
bool TlsSession::is_ready() const { return SSL_is_init_finished(impl_->ssl) == 1; }

void TlsSession::write(std::string_view plain) {
  while (!plain.empty() && !impl_->has_failed) {
    const int size = SSL_write(impl_->ssl, plain.data(), bounded(plain.size()));
    impl_->has_failed = size <= 0;
    plain.remove_prefix(std::size_t(std::max(size, 0)));
  }
}

bool TlsSession::end() {
  if (impl_->has_failed || !is_ready()) return false;
  return !std::exchange(impl_->has_said_end, true) && SSL_shutdown(impl_->ssl) >= 0;
}

std::string TlsSession::take_output() {
  BIO* const output = SSL_get_wbio(impl_->ssl);
  std::string bytes(BIO_ctrl_pending(output), '\0');
  const int size = bytes.empty() ? 0 : BIO_read(output, bytes.data(), bounded(bytes.size()));
  bytes.resize(std::size_t(std::max(size, 0)));
  return bytes;
}

class TlsServer::Impl {
 public:
  Impl() : context(SSL_CTX_new(TLS_server_method())) {}
  ~Impl() { SSL_CTX_free(context); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  SSL_CTX* const context;
};

TlsServer::TlsServer(const std::string& certificate, const std::string& key) : impl_(std::make_unique<Impl>()) {
  SSL_CTX* const context = impl_->context;
  if (!context) throw Error("TLS cannot be used: " + reason_of_openssl());
  ERR_clear_error();
  SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  SSL_CTX_set_default_passwd_cb(context, no_passphrase);
  if (SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) != 1)
    throw Error("the certificate " + quote(certificate) + " cannot be used: " + reason_of_openssl() +
                "; it must be a file in PEM format");
  if (SSL_CTX_use_PrivateKey_file(context, key.c_str(), SSL_FILETYPE_PEM) != 1)
    throw Error("the key " + quote(key) + " cannot be used: " + reason_of_openssl() +
                "; it must be that of the certificate, in PEM format, without a passphrase");
}

TlsServer::~TlsServer() = default;

std::unique_ptr<TlsSession> TlsServer::accept() const {
  return std::make_unique<TlsSession>(std::make_unique<TlsSession::Impl>(impl_->context));
}

}  // namespace muro::stream
