// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "plugins/controller/common/stream/connection.hpp"

namespace muro::stream {

/// The connections of one stream that are open now. [I/O thread]
class Connections final : public IoThread::Source {
 public:
  /// `tls`: null when nothing is encrypted.
  Connections(IoThread& io, Exchange& exchange, const Framing& framing, std::uint32_t most,
              std::unique_ptr<TlsServer> tls)
      : io_(io), exchange_(exchange), framing_(framing), most_(most), tls_(std::move(tls)) {}

  /// Serves the client of a descriptor. Returns false when it refuses the client and closes the descriptor.
  bool add(int descriptor, Connection::Descriptor kind);
  void close();
  void on_signal() override;
  bool empty() const { return all_.empty(); }
  /// Whether bytes for a client wait in this program.
  bool has_output() const;

  std::function<void(bool by_us)> on_closed;  ///< a client has gone, or this side has disconnected it

 private:
  void make_place();

  IoThread& io_;
  Exchange& exchange_;
  const Framing framing_;
  const std::uint32_t most_;
  const std::unique_ptr<TlsServer> tls_;
  std::vector<std::shared_ptr<Connection>> all_;
};

/// Everything that endpoints need to be made.
struct EndpointSetup {
  IoThread& io;
  Connections& connections;
  Address& address;
  const std::string& name;  ///< name of the stream
  Host& host;

  void log(LogLevel level, const std::string& text) const { host.log(level, "stream " + name + ": " + text); }
};

/// A source of clients: a server, a terminal, a device.
class Endpoint {
 public:
  virtual ~Endpoint() = default;
  /// Opens the endpoint; nothing happens before start(). Throws muro::Error. Not called in the I/O thread.
  virtual void open() = 0;
  virtual void start() = 0;  ///< [I/O thread]
  virtual void close() = 0;  ///< accepts no new clients [I/O thread]
  /// Sets the bit rate (bit/s) of a line that has one, after the earlier bytes have gone out. 0: the rate at opening.
  /// Allocates nothing. [step]
  virtual void set_baud(std::uint32_t) {}
};

std::unique_ptr<Endpoint> make_tcp_server(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_tcp_client(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_unix_server(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_pty(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_serial(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_endpoint(const EndpointSetup& setup);

}  // namespace muro::stream
