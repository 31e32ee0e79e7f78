// SPDX-License-Identifier: MIT
// Replaces tls.cpp when muro is built without OpenSSL.
#include "muro/algorithm.hpp"
#include "plugins/controller/common/stream/tls.hpp"

namespace muro::stream {

class TlsSession::Impl {};
class TlsServer::Impl {};

TlsServer::TlsServer(const std::string&, const std::string&) {
  throw Error(
      "this muro is built without OpenSSL, so that it cannot encrypt; build it again with libssl-dev installed");
}
TlsServer::~TlsServer() = default;
std::unique_ptr<TlsSession> TlsServer::accept() const { return nullptr; }

TlsSession::TlsSession(std::unique_ptr<Impl>) {}
TlsSession::~TlsSession() = default;
void TlsSession::take_in(std::string_view) {}
std::size_t TlsSession::read(char*, std::size_t) { return 0; }
bool TlsSession::has_ended() const { return true; }
bool TlsSession::has_failed() const { return true; }
bool TlsSession::is_ready() const { return false; }
void TlsSession::write(std::string_view) {}
bool TlsSession::end() { return false; }
std::string TlsSession::take_output() { return ""; }

}  // namespace muro::stream
