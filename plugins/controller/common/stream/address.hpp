// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "muro/connector.hpp"
#include "muro/parameter.hpp"

namespace muro::stream {

/// The parameter `stream` of a controller, read for one of its items.
///
/// In a scenario the parameter is a map. It arrives here as texts "key=value":
///
///     stream: {tcp: 4001}                         a server on 127.0.0.1; "0.0.0.0:4001" for all interfaces
///     stream: {connect: "192.168.0.7:4001"}       a client of a TCP server; tries again until there is one
///     stream: {unix: /tmp/muro-{index}.sock}      a server on a Unix socket, mode 0600
///     stream: {pty: "/tmp/{robot}.laser"}         a pseudo-terminal; the name is a link to it
///     stream: {serial: /dev/ttyS0, baud: 115200}  a serial device
///
/// `{robot}` is the name of the robot, `{index}` the number at the end of the name (bots_7: 7; 0 when there is none). A
/// port may be a sum, "4001+{index}". Relative paths start in the working directory. The README lists all keys.
struct Address {
  enum class Kind : std::uint8_t { tcp_server, tcp_client, unix_server, pty, serial };
  Kind kind = Kind::tcp_server;
  std::string host;             ///< host of TCP, as given; "127.0.0.1" when none is given
  std::uint16_t port = 0;       ///< port of TCP; 0: any free port, which a log line reports
  std::string path;             ///< a Unix socket, a serial device, or the link to a pseudo-terminal; absolute
  std::uint32_t baud = 0;       ///< bit rate of a serial device, bit/s; 0: its present rate
  bool is_timed = false;        ///< bytes take time at `baud` (10 bits a byte), in simulated time
  std::uint32_t clients = 8;    ///< most clients at once; 1 for all but servers, and when `is_timed`
  std::string lockstep;         ///< name of the client for which simulated time waits; empty: it waits for none
  double timeout = 10;          ///< longest time of such a wait, s of the wall clock
  bool ends_on_timeout = true;  ///< false: time goes on, and the run is marked as not repeatable

  /// Files of a TCP server that encrypts (TLS), in PEM format; empty: no TLS. The reader of the address sets them.
  std::string certificate, key;

  bool is_loopback() const;  ///< whether no other machine can reach it
  std::string text() const;  ///< text for messages: "tcp 127.0.0.1:4001"
};

/// Returns the parameter, with the keys above: tcp, connect, unix, pty, serial, baud, timed, clients, lockstep,
/// timeout, on_timeout.
constexpr Parameter stream_parameter() {
  return texts("stream",
               "where clients are served: {tcp: PORT}, {connect: \"HOST:PORT\"}, {unix: PATH}, {pty: PATH} or {serial: "
               "DEVICE, baud: RATE}");
}

/// Reads the parameter for one item of `connector`. Throws muro::Error with what is wrong and what is allowed. [setup]
Address read_address(const Connector& connector, std::uint32_t item, std::span<const std::string_view> texts);

}  // namespace muro::stream
