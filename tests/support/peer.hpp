// SPDX-License-Identifier: MIT
// Clients over sockets and terminals, of plain POSIX, and where simulators serve them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace muro::test {

/// The port in "stream STREAM: serves on tcp HOST:PORT", which streams write to the log; without a name that of the
/// first that is there. 0: there is none.
std::uint16_t tcp_port_in(std::string_view log, std::string_view stream = {});

/// Sockets of this machine's loopback interface, and of paths; -1: `errno` says why there is none.
int connected_to_tcp(std::uint16_t port);
int connected_to_unix(const std::string& path);
/// Not listening yet. Port 0: one that is free.
int bound_to_tcp(std::uint16_t port = 0);
int bound_to_unix(const std::string& path);
std::uint16_t port_of(int socket);

/// A descriptor with what a client does.
class Peer {
 public:
  explicit Peer(int its_fd);  ///< and expects that it is one
  Peer(Peer&& other) noexcept
      : fd(std::exchange(other.fd, -1)), heard(std::move(other.heard)), is_closed(other.is_closed) {}
  Peer& operator=(Peer&&) = delete;
  ~Peer() { close(); }

  static Peer tcp(std::uint16_t port) { return Peer(connected_to_tcp(port)); }
  /// Waits for up to 10 s until somebody serves there.
  static Peer tcp_once_served(std::uint16_t port);
  static Peer unix_socket(const std::string& path) { return Peer(connected_to_unix(path)); }
  static Peer file(const std::string& path);

  void close();
  /// Closed by a reset: it is gone, with what was on its way.
  void reset();
  /// What it says from now on is nothing; it still listens.
  void end() const;
  /// True: all of it is on its way.
  bool say(std::string_view text) const;
  /// What has come, without waiting.
  std::string hear();
  /// The same until the other side closes.
  std::string hear_all();
  /// The next whole line without its end, taken from what has been heard. False: there is none yet.
  bool take_line(std::string& line);
  /// The same, waited for. Empty where the connection is closed, or nothing comes within 10 s.
  std::string wait_line();

  int fd;
  std::string heard;
  bool is_closed = false;  ///< by the other side

 private:
  bool take_in(int wait_ms);
};

}  // namespace muro::test
