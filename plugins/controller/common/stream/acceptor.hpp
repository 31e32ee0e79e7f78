// SPDX-License-Identifier: MIT
#pragma once

#include <sys/socket.h>

#include <boost/asio/steady_timer.hpp>

#include "plugins/controller/common/stream/endpoint.hpp"
#include "plugins/controller/common/stream/system_error.hpp"

namespace muro::stream {

/// Accepts clients on a listening socket. [I/O thread]
class Acceptor {
 public:
  /// Takes ownership of the descriptor. `prepare`: sets the options of a client's socket.
  Acceptor(const EndpointSetup& setup, int descriptor, void (*prepare)(int))
      : setup_(setup), socket_(setup.io.context(), descriptor), timer_(setup.io.context()), prepare_(prepare) {}

  void accept() {
    socket_.async_wait(asio::posix::descriptor_base::wait_read, [this](const boost::system::error_code& error) {
      if (!error && socket_.is_open()) accept_now();
    });
  }
  void close() {
    timer_.cancel();
    boost::system::error_code ignored;
    socket_.close(ignored);
  }

 private:
  void accept_now() {
    const int client = ::accept4(socket_.native_handle(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (client >= 0) {
      prepare_(client);
      setup_.connections.add(client, Connection::Descriptor::socket);
    } else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
      wait(errno);
      return;
    }
    accept();
  }
  /// Waits before it accepts again. Meanwhile clients wait in the queue of the system.
  void wait(int error) {
    if (!is_told_) setup_.log(LogLevel::warning, "cannot take a client: " + system_reason(error));
    is_told_ = true;
    timer_.expires_after(std::chrono::milliseconds(200));
    timer_.async_wait([this](const boost::system::error_code& cancelled) {
      if (!cancelled && socket_.is_open()) accept();
    });
  }

  const EndpointSetup setup_;
  asio::posix::stream_descriptor socket_;
  asio::steady_timer timer_;
  void (*const prepare_)(int);
  bool is_told_ = false;
};

}  // namespace muro::stream
