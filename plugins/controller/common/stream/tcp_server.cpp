// SPDX-License-Identifier: MIT
#include <fcntl.h>

#include <deque>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/acceptor.hpp"
#include "plugins/controller/common/stream/in_a_team.hpp"
#include "plugins/controller/common/stream/tcp.hpp"

namespace muro::stream {

namespace {

using asio::ip::tcp;

class TcpServer final : public Endpoint {
 public:
  explicit TcpServer(const EndpointSetup& setup) : setup_(setup) {}

  void open() override {
    const std::vector<tcp::endpoint> endpoints = resolve(setup_, true);
    int last_error = 0;
    for (tcp::endpoint endpoint : endpoints) {
      endpoint.port(setup_.address.port);  // port of the first endpoint, when any port was allowed
      const int socket = listening(endpoint, last_error);
      if (socket >= 0) acceptors_.emplace_back(setup_, socket, set_tcp_options);
    }
    if (acceptors_.empty()) fail(last_error);
    setup_.log(LogLevel::info, "serves on " + setup_.address.text() +
                                   (setup_.address.is_loopback() ? "" : ", for whoever can reach this machine"));
  }
  void start() override {
    for (Acceptor& acceptor : acceptors_) acceptor.accept();
  }
  void close() override {
    for (Acceptor& acceptor : acceptors_) acceptor.close();
  }

 private:
  /// Returns a listening socket; -1 and `error` when this machine lacks this address, which may be one of several.
  int listening(const tcp::endpoint& endpoint, int& error) {
    tcp::acceptor acceptor(setup_.io.context());
    boost::system::error_code code;
    acceptor.open(endpoint.protocol(), code);
    if (!code) acceptor.set_option(tcp::acceptor::reuse_address(true), code);
    if (!code && endpoint.protocol() == tcp::v6())
      acceptor.set_option(asio::ip::v6_only(!endpoint.address().is_unspecified()), code);
    if (!code) acceptor.bind(endpoint, code);
    if (!code) acceptor.listen(tcp::acceptor::max_listen_connections, code);
    if (!code) acceptor.native_non_blocking(true, code);
    if (code) {
      error = code.value();
      if (error != EAFNOSUPPORT && error != EADDRNOTAVAIL) fail(error);
      return -1;
    }
    ::fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
    if (setup_.address.port == 0) setup_.address.port = acceptor.local_endpoint().port();
    return acceptor.release();
  }

  [[noreturn]] void fail(int error) const {
    std::string why = system_reason(error);
    if (error == EADDRINUSE)
      why = port_is_taken(setup_.address.port);
    else if (error == EACCES)
      why = "port " + std::to_string(setup_.address.port) +
            " may only be served by the administrator; choose one from 1024 to 65535";
    else if (error == EADDRNOTAVAIL)
      why = quote(setup_.address.host) +
            " is no address of this machine; write 127.0.0.1, 0.0.0.0 for all of its "
            "interfaces, or the address of one of them";
    throw Error("stream " + quote(setup_.name) + " cannot serve on " + setup_.address.text() + ": " + why);
  }

  const EndpointSetup setup_;
  std::deque<Acceptor> acceptors_;
};

}  // namespace

std::unique_ptr<Endpoint> make_tcp_server(const EndpointSetup& setup) { return std::make_unique<TcpServer>(setup); }

}  // namespace muro::stream
