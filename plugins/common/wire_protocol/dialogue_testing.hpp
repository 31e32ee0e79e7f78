// SPDX-License-Identifier: MIT
// Dialogues with controllers of a simulation over TCP, for tests.
#pragma once

#include <gtest/gtest.h>
#include <poll.h>

#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/common/stream/echo_testing.hpp"
#include "tests/support/scene.hpp"

namespace muro::wire {

using Settings = std::map<std::string, ParameterInput>;
using Texts = std::vector<std::string>;

/// A simulation that knows on which ports it serves.
struct Served : test::Scene {
  explicit Served(std::uint64_t seed = 1) : Scene(seed) {
    set_log([this](LogLevel level, std::string_view text) {
      if (level >= LogLevel::warning) warnings.emplace_back(text);
      constexpr std::string_view before = ": serves on tcp 127.0.0.1:";
      const std::size_t at = text.find(before), stream = text.find("stream ");
      if (at == text.npos) return;
      const std::size_t name = stream + 7;
      ports[std::string(text.substr(name, at - name))] =
          std::uint16_t(std::stoi(std::string(text.substr(at + before.size()))));
    });
  }
  /// The port of a stream: "arm_0/joints".
  std::uint16_t port(const std::string& stream) const {
    const auto found = ports.find(stream);
    EXPECT_NE(found, ports.end()) << "no stream " << stream;
    return found == ports.end() ? 0 : found->second;
  }
  std::map<std::string, std::uint16_t> ports;
  std::vector<std::string> warnings;
};

/// A client with what it has heard.
class Client {
 public:
  explicit Client(std::uint16_t port) : peer_(stream::Peer::tcp(port)) {}

  void say(std::string_view bytes) const { EXPECT_TRUE(peer_.say(bytes)); }
  void close() { peer_.close(); }
  bool is_closed() const { return peer_.is_closed; }
  /// Bytes that have come and were not taken yet.
  std::string& heard() {
    peer_.hear();
    return peer_.heard;
  }
  /// The next whole line without its end; "" and false: there is none yet.
  bool take_line(std::string& line) {
    std::string& all = heard();
    const std::size_t end = all.find('\n');
    if (end == all.npos) return false;
    line = all.substr(0, end);
    all.erase(0, end + 1);
    return true;
  }
  /// Waits for a line of a simulation that runs by itself.
  std::string wait_line() {
    for (std::string line; !is_closed();) {
      if (take_line(line)) return line;
      pollfd readable{peer_.fd, POLLIN, 0};
      if (::poll(&readable, 1, 10'000) != 1) break;
    }
    return "";
  }
  std::string ask_running(const std::string& line) {
    say(line + "\n");
    return wait_line();
  }

 private:
  stream::Peer peer_;
};

/// Runs until `done`, in steps of `seconds`, for at most 5 s of the wall clock.
template <class Done>
bool run_until(test::Scene& s, Done done, double seconds = 0.01) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    s.run_for(seconds);
    ::usleep(100);
  }
  return true;
}

/// The next line that the client hears, while the simulation runs.
inline std::string next_line(test::Scene& s, Client& client, double seconds = 0.01) {
  std::string line;
  EXPECT_TRUE(run_until(
      s, [&] { return client.take_line(line); }, seconds))
      << "no reply";
  return line;
}
inline std::string ask(test::Scene& s, Client& client, const std::string& line, double seconds = 0.01) {
  client.say(line + "\n");
  return next_line(s, client, seconds);
}

/// The numbers of a reply, behind its first word.
inline std::vector<double> numbers_of(const std::string& reply) {
  std::vector<double> numbers;
  const char* at = reply.c_str();
  at += std::strcspn(at, " ");
  for (char* end = nullptr;; at = end) {
    const double number = std::strtod(at, &end);
    if (end == at) return numbers;
    numbers.push_back(number);
  }
}

}  // namespace muro::wire
