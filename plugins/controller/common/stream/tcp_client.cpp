// SPDX-License-Identifier: MIT
#include <boost/asio/connect.hpp>

#include "plugins/controller/common/stream/retry.hpp"
#include "plugins/controller/common/stream/tcp.hpp"

namespace muro::stream {

namespace {

using asio::ip::tcp;

/// Connects to a server, and tries again when there is none yet or the connection is lost.
class TcpClient final : public Endpoint {
 public:
  explicit TcpClient(const EndpointSetup& setup)
      : setup_(setup), socket_(setup.io.context()), retry_(setup.io, [this] { connect(); }) {}

  void open() override { servers_ = resolve(setup_, false); }
  void start() override {
    setup_.connections.on_closed = [this](bool) { retry_.later(); };
    connect();
  }
  void close() override {
    retry_.stop();
    boost::system::error_code ignored;
    socket_.close(ignored);
  }

 private:
  void connect() {
    socket_ = tcp::socket(setup_.io.context());
    asio::async_connect(socket_, servers_, [this](const boost::system::error_code& error, const tcp::endpoint&) {
      if (error == asio::error::operation_aborted) return;
      if (!retry_.is_stopped()) connected(error);
    });
  }
  void connected(boost::system::error_code error) {
    if (!error && is_connected_to_itself()) error = asio::error::connection_refused;
    if (!error) socket_.native_non_blocking(true, error);
    if (error) {
      if (!is_told_) setup_.log(LogLevel::info, "waits for " + setup_.address.text() + ": " + error.message());
      is_told_ = true;
      retry_.later();
      return;
    }
    const int descriptor = socket_.release();
    set_tcp_options(descriptor);
    if (!setup_.connections.add(descriptor, Connection::Descriptor::socket)) retry_.later();
  }
  /// Detects a connection to itself: TCP makes one when a local port has no server and is free for clients.
  bool is_connected_to_itself() const {
    boost::system::error_code error;
    const tcp::endpoint local = socket_.local_endpoint(error);
    return !error && local == socket_.remote_endpoint(error);
  }

  const EndpointSetup setup_;
  std::vector<tcp::endpoint> servers_;
  tcp::socket socket_;
  Retry retry_;
  bool is_told_ = false;
};

}  // namespace

std::unique_ptr<Endpoint> make_tcp_client(const EndpointSetup& setup) { return std::make_unique<TcpClient>(setup); }

}  // namespace muro::stream
