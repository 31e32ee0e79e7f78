// SPDX-License-Identifier: MIT
// TLS between a server session and a client of OpenSSL, through memory.
#include "plugins/controller/common/stream/tls.hpp"

#include <gtest/gtest.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <cstdio>

#include "muro/algorithm.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {
namespace {

/// A self-signed certificate and its key.
struct Certificate {
  Certificate() {
    EVP_PKEY* const key = EVP_EC_gen("P-256");
    X509* const certificate = X509_new();
    X509_gmtime_adj(X509_getm_notBefore(certificate), 0);
    X509_gmtime_adj(X509_getm_notAfter(certificate), 3600);
    X509_set_pubkey(certificate, key);
    X509_NAME* const name = X509_get_subject_name(certificate);
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("muro"), -1, -1, 0);
    X509_set_issuer_name(certificate, name);
    X509_sign(certificate, key, EVP_sha256());
    FILE* file = std::fopen(folder.path("certificate.pem").c_str(), "w");
    PEM_write_X509(file, certificate);
    std::fclose(file);
    file = std::fopen(folder.path("key.pem").c_str(), "w");
    PEM_write_PrivateKey(file, key, nullptr, nullptr, 0, nullptr, nullptr);
    std::fclose(file);
    X509_free(certificate);
    EVP_PKEY_free(key);
  }
  TlsServer server() const { return {folder.path("certificate.pem"), folder.path("key.pem")}; }
  test::ScratchFolder folder;
};

/// A client without a socket.
class MemoryClient {
 public:
  explicit MemoryClient(int newest = TLS1_3_VERSION) : context_(SSL_CTX_new(TLS_client_method())) {
    SSL_CTX_set_max_proto_version(context_, newest);
    SSL_CTX_set_security_level(context_, 0);
    ssl_ = SSL_new(context_);
    SSL_set_bio(ssl_, BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
    SSL_set_connect_state(ssl_);
  }
  ~MemoryClient() {
    SSL_free(ssl_);
    SSL_CTX_free(context_);
  }
  void say(std::string_view text) { unsaid_ += text; }
  void end() { SSL_shutdown(ssl_); }
  /// Carries bytes in both directions until none remain. Returns the bytes that the server received.
  std::string talk_to(TlsSession& server) {
    std::string heard;
    for (int quiet = 0; quiet < 3;) {
      char buffer[5000];
      for (int n; (n = SSL_read(ssl_, buffer, sizeof buffer)) > 0;) heard_.append(buffer, std::size_t(n));
      if (SSL_is_init_finished(ssl_) == 1 && !unsaid_.empty()) {
        SSL_write(ssl_, unsaid_.data(), int(unsaid_.size()));
        unsaid_.clear();
      }
      ERR_clear_error();
      const std::string to_client = server.take_output();
      if (!to_client.empty()) BIO_write(SSL_get_rbio(ssl_), to_client.data(), int(to_client.size()));
      const int size = BIO_read(SSL_get_wbio(ssl_), buffer, sizeof buffer);
      if (size > 0) server.take_in({buffer, std::size_t(size)});
      for (std::size_t n; (n = server.read(buffer, 100)) > 0;) heard.append(buffer, n);
      quiet = to_client.empty() && size <= 0 ? quiet + 1 : 0;
    }
    return heard;
  }
  const std::string& heard() const { return heard_; }

 private:
  SSL_CTX* context_;
  SSL* ssl_;
  std::string unsaid_, heard_;
};

TEST(Tls, CarriesWhatBothSidesSay) {
  const Certificate certificate;
  const TlsServer server = certificate.server();
  const auto session = server.accept();
  MemoryClient client;
  EXPECT_FALSE(session->is_ready());
  std::string much;
  for (int i = 0; i < 100'000; ++i) much += std::to_string(i) + ",";
  client.say(much);
  EXPECT_EQ(client.talk_to(*session), much);
  EXPECT_TRUE(session->is_ready());
  session->write(much);
  client.talk_to(*session);
  EXPECT_EQ(client.heard(), much);
}

TEST(Tls, IsToldWhenTheOtherSideHasSaidAll) {
  const Certificate certificate;
  const TlsServer server = certificate.server();
  const auto session = server.accept();
  MemoryClient client;
  client.say("last words");
  EXPECT_EQ(client.talk_to(*session), "last words");
  EXPECT_FALSE(session->has_ended());
  client.end();
  client.talk_to(*session);
  EXPECT_TRUE(session->has_ended());
  EXPECT_FALSE(session->has_failed());
  session->write("an answer");
  EXPECT_TRUE(session->end());
  EXPECT_FALSE(session->end()) << "once";
}

TEST(Tls, FailsWhereAnotherProtocolIsSpoken) {
  const Certificate certificate;
  const TlsServer server = certificate.server();
  for (const std::string& words : {std::string("{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"time\"}\n"),
                                   std::string("GET / HTTP/1.1\r\n\r\n"), std::string(100, '\0')}) {
    const auto session = server.accept();
    char buffer[100];
    session->take_in(words);
    EXPECT_EQ(session->read(buffer, sizeof buffer), 0u);
    EXPECT_TRUE(session->has_failed());
    EXPECT_FALSE(session->is_ready());
    EXPECT_FALSE(session->end());
  }
}

TEST(Tls, RefusesVersionsThatAreNotSafeAnyMore) {
  const Certificate certificate;
  const TlsServer server = certificate.server();
  const auto session = server.accept();
  MemoryClient client(TLS1_1_VERSION);
  client.say("hello");
  EXPECT_EQ(client.talk_to(*session), "");
  EXPECT_TRUE(session->has_failed());
}

TEST(Tls, SaysWhatIsWrongWithItsFiles) {
  const Certificate certificate;
  const auto complaint = [](const std::string& file, const std::string& key) -> std::string {
    try {
      const TlsServer server(file, key);
      return "it is fine";
    } catch (const Error& e) {
      return e.what();
    }
  };
  const std::string file = certificate.folder.path("certificate.pem"), key = certificate.folder.path("key.pem");
  EXPECT_EQ(complaint(file, key), "it is fine");
  EXPECT_EQ(complaint("/nowhere", key).find("the certificate `/nowhere` cannot be used: "), 0u);
  EXPECT_EQ(complaint(file, file).find("the key `" + file + "` cannot be used: "), 0u);
  const Certificate other;
  EXPECT_NE(complaint(file, other.folder.path("key.pem")).find("must be that of the certificate"), std::string::npos);
}

}  // namespace
}  // namespace muro::stream
