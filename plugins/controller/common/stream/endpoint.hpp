// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "plugins/controller/common/stream/connection.hpp"

namespace muro::stream {

/// The clients of one stream that are there now. [I/O thread]
class Connections final : public IoThread::Source {
 public:
  /// `tls`: null where nothing is encrypted.
  Connections(IoThread& io, Exchange& exchange, const Framing& framing, std::uint32_t most,
              std::unique_ptr<TlsServer> tls)
      : io_(io), exchange_(exchange), framing_(framing), most_(most), tls_(std::move(tls)) {}

  /// Serves the client behind a descriptor, or refuses it and closes that.
  bool add(int descriptor, Connection::Descriptor kind);
  void close();
  void on_signal() override;
  bool empty() const { return all_.empty(); }
  /// Whether bytes for a client wait in this program.
  bool has_output() const;

  std::function<void(bool by_us)> on_closed;  ///< a client has gone, or was disconnected here

 private:
  void make_place();

  IoThread& io_;
  Exchange& exchange_;
  const Framing framing_;
  const std::uint32_t most_;
  const std::unique_ptr<TlsServer> tls_;
  std::vector<std::shared_ptr<Connection>> all_;
};

/// What endpoints are made of.
struct EndpointSetup {
  IoThread& io;
  Connections& connections;
  Address& address;
  const std::string& name;  ///< of the stream
  Host& host;

  void log(LogLevel level, const std::string& text) const { host.log(level, "stream " + name + ": " + text); }
};

/// Where clients come from: a server, a terminal, a device.
class Endpoint {
 public:
  virtual ~Endpoint() = default;
  /// Throws muro::Error. Not in the I/O thread; nothing happens before start().
  virtual void open() = 0;
  virtual void start() = 0;  ///< [I/O thread]
  virtual void close() = 0;  ///< no new clients [I/O thread]
  /// bit/s of a line that has them, once what was sent before has gone out; 0: as it was opened. Allocates nothing.
  /// [step]
  virtual void set_baud(std::uint32_t) {}
};

std::unique_ptr<Endpoint> make_tcp_server(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_tcp_client(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_unix_server(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_pty(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_serial(const EndpointSetup& setup);
std::unique_ptr<Endpoint> make_endpoint(const EndpointSetup& setup);

}  // namespace muro::stream
