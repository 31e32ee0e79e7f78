// SPDX-License-Identifier: MIT
// Clients over sockets and terminals, with plain POSIX, and the addresses of servers in simulators.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace muro::test {

/// Returns the port in "stream STREAM: serves on tcp HOST:PORT", which streams write to the log; without a name that of
/// the first stream. 0: there is none.
std::uint16_t tcp_port_in(std::string_view log, std::string_view stream = {});

/// Returns a socket of the loopback interface, or of a path; -1: `errno` gives the reason.
int connected_to_tcp(std::uint16_t port);
int connected_to_unix(const std::string& path);
/// Returns a socket that does not listen yet. Port 0: one that is free.
int bound_to_tcp(std::uint16_t port = 0);
int bound_to_unix(const std::string& path);
std::uint16_t port_of(int socket);

/// A descriptor with the operations of a client.
class Peer {
 public:
  explicit Peer(int its_fd);  ///< expects a valid descriptor
  Peer(Peer&& other) noexcept
      : fd(std::exchange(other.fd, -1)), heard(std::move(other.heard)), is_closed(other.is_closed) {}
  Peer& operator=(Peer&&) = delete;
  ~Peer() { close(); }

  static Peer tcp(std::uint16_t port) { return Peer(connected_to_tcp(port)); }
  /// Connects when there is a server; waits for up to 10 s.
  static Peer tcp_once_served(std::uint16_t port);
  static Peer unix_socket(const std::string& path) { return Peer(connected_to_unix(path)); }
  static Peer file(const std::string& path);

  void close();
  /// Closes the connection by a reset: data on its way is lost.
  void reset();
  /// Sends nothing from now on, but still receives.
  void end() const;
  /// Sends the text. True: all of it has been sent.
  bool say(std::string_view text) const;
  /// Returns what has come, without waiting.
  std::string hear();
  /// Returns all that comes until the other side closes.
  std::string hear_all();
  /// Takes the next whole line, without its end, from what has been received. False: there is none yet.
  bool take_line(std::string& line);
  /// Waits for the next line. Empty if the connection is closed or nothing comes within 10 s.
  std::string wait_line();

  int fd;
  std::string heard;
  bool is_closed = false;  ///< by the other side

 private:
  bool take_in(int wait_ms);
};

}  // namespace muro::test
