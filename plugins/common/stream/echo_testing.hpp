// SPDX-License-Identifier: MIT
// A stream that answers each message with itself, and clients of plain POSIX, for tests.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <functional>
#include <optional>

#include "muro/algorithm.hpp"
#include "plugins/common/stream/fake_host_testing.hpp"
#include "plugins/common/stream/stream.hpp"

namespace muro::stream {

inline Address address_of(const Connector& connector, const std::vector<std::string_view>& texts,
                          std::uint32_t item = 0) {
  return read_address(connector, item, texts);
}

/// What a Stream hands out, with memory of its own.
struct Heard {
  Event::Kind kind;
  std::uint32_t client;
  std::string bytes;
  std::int64_t time;
  bool operator==(const Heard&) const = default;
};

/// A simulation of a stream alone, with steps of a millisecond.
struct Echo {
  explicit Echo(const std::vector<std::string_view>& texts, Framing framing = {line_size}, Limits limits = {})
      : stream(connector, "rover_3/echo", address_of(connector, texts), framing, limits) {
    stream.open();
  }
  Echo(FakeInputs& inputs, const std::vector<std::string_view>& texts, Lockstep* lockstep = nullptr)
      : with_host(connector, inputs, lockstep),
        stream(connector, "rover_3/echo", address_of(connector, texts), {line_size}) {
    stream.open();
  }

  void step() {
    stream.begin(time);
    while (const Event* const event = stream.next()) {
      heard.push_back({event->kind, event->client, std::string(event->bytes), time});
      if (event->kind != Event::Kind::message) continue;
      if (answers) stream.send(event->client, event->bytes);
      stream.answered();
    }
    time += 1'000'000;
  }
  /// Steps until `done`. False: it was not within 5 s.
  bool run_until(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) return false;
      step();
      usleep(200);
    }
    return true;
  }
  std::uint16_t port() const { return stream.address().port; }
  std::size_t count(Event::Kind kind) const {
    return std::size_t(std::count_if(heard.begin(), heard.end(), [&](const Heard& h) { return h.kind == kind; }));
  }

  struct WithHost {
    WithHost() = default;
    WithHost(FakeConnector& connector, FakeInputs& inputs, Lockstep* lockstep) {
      connector.fake_host.inputs = &inputs;
      connector.fake_host.lockstep = lockstep;
    }
  };
  FakeConnector connector;
  WithHost with_host;
  Stream stream;
  bool answers = true;
  std::int64_t time = 0;
  std::vector<Heard> heard;
};

/// A descriptor with what a client does.
class Peer {
 public:
  explicit Peer(int its_fd) : fd(its_fd) { EXPECT_GE(fd, 0) << std::strerror(errno); }
  Peer(Peer&& other) noexcept : fd(std::exchange(other.fd, -1)) {}
  Peer& operator=(Peer&&) = delete;
  ~Peer() { close(); }

  static Peer tcp(std::uint16_t port) {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0) << std::strerror(errno);
    return Peer(fd);
  }
  static Peer unix_socket(const std::string& path) {
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    path.copy(to.sun_path, sizeof to.sun_path - 1);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0) << std::strerror(errno);
    return Peer(fd);
  }
  static Peer file(const std::string& path) { return Peer(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)); }

  void close() {
    if (fd >= 0) ::close(fd);
    fd = -1;
  }
  /// Closed by a reset: it is gone, with what was on its way.
  void reset() {
    const linger at_once{1, 0};
    ::setsockopt(fd, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close();
  }
  bool say(std::string_view text) const { return ::write(fd, text.data(), text.size()) == ssize_t(text.size()); }
  /// What has come, without waiting.
  std::string hear() {
    char buffer[65536];
    while (true) {
      pollfd readable{fd, POLLIN, 0};
      if (::poll(&readable, 1, 0) != 1) break;
      const ssize_t size = ::read(fd, buffer, sizeof buffer);
      is_closed |= size <= 0;
      if (size <= 0) break;
      heard.append(buffer, std::size_t(size));
    }
    return heard;
  }

  int fd;
  std::string heard;
  bool is_closed = false;  ///< by the other side
};

inline std::size_t open_descriptors() {
  std::size_t count = 0;
  for (int fd = 0; fd < 4096; ++fd) count += ::fcntl(fd, F_GETFD) >= 0 ? 1 : 0;
  return count;
}

}  // namespace muro::stream
