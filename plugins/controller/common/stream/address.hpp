// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "muro/connector.hpp"
#include "muro/parameter.hpp"

namespace muro::stream {

/// What the parameter `stream` of a controller says, for one of its items.
///
/// In a scenario it is a map, which arrives here as texts "key=value":
///
///     stream: {tcp: 4001}                         a server on 127.0.0.1; "0.0.0.0:4001" for all interfaces
///     stream: {connect: "192.168.0.7:4001"}       a client of a TCP server; tries again until there is one
///     stream: {unix: /tmp/muro-{index}.sock}      a server on a Unix socket, mode 0600
///     stream: {pty: "/tmp/{robot}.laser"}         a pseudo-terminal; the name is a link to it
///     stream: {serial: /dev/ttyS0, baud: 115200}  a serial device
///
/// `{robot}` is the robot's name, `{index}` the number at its end (bots_7: 7; 0 where it has none). A port may be a
/// sum, "4001+{index}". Paths that are relative start in the working directory. The README of this folder has all keys.
struct Address {
  enum class Kind : std::uint8_t { tcp_server, tcp_client, unix_server, pty, serial };
  Kind kind = Kind::tcp_server;
  std::string host;             ///< of TCP, as given; "127.0.0.1" when none is
  std::uint16_t port = 0;       ///< of TCP; 0: any that is free, which a log line tells
  std::string path;             ///< of a Unix socket, of the link to a pseudo-terminal, of a serial device; absolute
  std::uint32_t baud = 0;       ///< bit/s of a serial device; 0: as it is set
  bool is_timed = false;        ///< bytes take their time at `baud` (10 bits a byte), in simulated time
  std::uint32_t clients = 8;    ///< at most, at once; one but for servers, and where bytes take their time
  std::string lockstep;         ///< name of the client for which time waits; empty: it does not
  double timeout = 10;          ///< s of the wall clock that such a wait may take
  bool ends_on_timeout = true;  ///< false: time goes on, and the run is marked as not repeatable

  /// Files of a TCP server that encrypts (TLS), in PEM format; empty: it does not. Who reads the address sets them.
  std::string certificate, key;

  bool is_loopback() const;  ///< nobody on another machine can reach it
  std::string text() const;  ///< for messages: "tcp 127.0.0.1:4001"
};

/// The parameter, with the keys above: tcp, connect, unix, pty, serial, baud, timed, clients, lockstep, timeout,
/// on_timeout.
constexpr Parameter stream_parameter() {
  return texts("stream",
               "where clients are served: {tcp: PORT}, {connect: \"HOST:PORT\"}, {unix: PATH}, {pty: PATH} or {serial: "
               "DEVICE, baud: RATE}");
}

/// Reads it for one item of `connector`. Throws muro::Error that says what is wrong and what is allowed. [setup]
Address read_address(const Connector& connector, std::uint32_t item, std::span<const std::string_view> texts);

}  // namespace muro::stream
