// SPDX-License-Identifier: MIT
#include "tests/support/peer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>

namespace muro::test {

namespace {

constexpr int patience_ms = 10'000;

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  return address;
}

/// Returns the socket for which `act` is 0, or -1 if it is not.
template <class Address>
int socket_at(const Address& address, int (*act)(int, const sockaddr*, socklen_t)) {
  const auto* const where = reinterpret_cast<const sockaddr*>(&address);
  const int fd = ::socket(where->sa_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  if (fd >= 0 && act == ::bind) ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (fd < 0 || act(fd, where, sizeof address) == 0) return fd;
  const int why = errno;
  ::close(fd);
  errno = why;
  return -1;
}

}  // namespace

std::uint16_t tcp_port_in(std::string_view log, std::string_view stream) {
  const std::string who = stream.empty() ? "" : "stream " + std::string(stream) + ": ";
  const std::string told = who + "serves on tcp ";
  const std::size_t at = log.find(told);
  if (at == log.npos) return 0;
  std::string_view where = log.substr(at + told.size());
  where = where.substr(0, where.find_first_of(", \r\n"));
  const std::size_t colon = where.rfind(':');
  std::uint16_t port = 0;
  if (colon != where.npos) std::from_chars(where.data() + colon + 1, where.data() + where.size(), port);
  return port;
}

int connected_to_tcp(std::uint16_t port) { return socket_at(loopback(port), ::connect); }

int connected_to_unix(const std::string& path) { return socket_at(unix_address(path), ::connect); }

int bound_to_tcp(std::uint16_t port) { return socket_at(loopback(port), ::bind); }

int bound_to_unix(const std::string& path) { return socket_at(unix_address(path), ::bind); }

std::uint16_t port_of(int socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

Peer::Peer(int its_fd) : fd(its_fd) { EXPECT_GE(fd, 0) << std::strerror(errno); }

Peer Peer::tcp_once_served(std::uint16_t port) {
  int fd = connected_to_tcp(port);
  for (int waited_ms = 0; fd < 0 && waited_ms < patience_ms; waited_ms += 20) {
    ::usleep(20'000);
    fd = connected_to_tcp(port);
  }
  return Peer(fd);
}

Peer Peer::file(const std::string& path) { return Peer(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)); }

void Peer::close() {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

void Peer::reset() {
  const linger at_once{1, 0};
  ::setsockopt(fd, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close();
}

void Peer::end() const { EXPECT_EQ(::shutdown(fd, SHUT_WR), 0) << std::strerror(errno); }

bool Peer::say(std::string_view text) const {
  ssize_t size = ::send(fd, text.data(), text.size(), MSG_NOSIGNAL);
  if (size < 0 && errno == ENOTSOCK) size = ::write(fd, text.data(), text.size());
  return size == ssize_t(text.size());
}

/// Reads what comes next. False: nothing came, or the other side has closed the connection.
bool Peer::take_in(int wait_ms) {
  char buffer[65536];
  pollfd readable{fd, POLLIN, 0};
  if (::poll(&readable, 1, wait_ms) != 1) return false;
  const ssize_t size = ::read(fd, buffer, sizeof buffer);
  is_closed |= size <= 0;
  if (size > 0) heard.append(buffer, std::size_t(size));
  return size > 0;
}

std::string Peer::hear() {
  while (take_in(0)) continue;
  return heard;
}

std::string Peer::hear_all() {
  while (take_in(patience_ms)) continue;
  EXPECT_TRUE(is_closed) << "nothing more came, and nobody has closed: " << heard;
  return heard;
}

bool Peer::take_line(std::string& line) {
  const std::size_t end = heard.find('\n');
  if (end == heard.npos) return false;
  line = heard.substr(0, end);
  heard.erase(0, end + 1);
  return true;
}

std::string Peer::wait_line() {
  std::string line;
  while (!take_line(line))
    if (!take_in(patience_ms)) return "";
  return line;
}

}  // namespace muro::test
