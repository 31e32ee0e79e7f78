// SPDX-License-Identifier: MIT
// Dialogues with controllers of a simulation over TCP, for tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/peer.hpp"
#include "tests/support/scene.hpp"

namespace muro::wire {

using Settings = std::map<std::string, ParameterInput>;
using Texts = std::vector<std::string>;

/// A simulation that finds the ports of its streams.
struct Served : test::Scene {
  explicit Served(std::uint64_t seed = 1) : Scene(seed) {
    set_log([this](LogLevel level, std::string_view text) {
      if (level >= LogLevel::warning) warnings.emplace_back(text);
      log += std::string(text) + "\n";
    });
  }
  /// Returns the port of a stream: "arm_0/joints".
  std::uint16_t port(const std::string& stream) const {
    const std::uint16_t found = test::tcp_port_in(log, stream);
    EXPECT_NE(found, 0) << "no stream " << stream << ": " << log;
    return found;
  }
  std::string log;
  std::vector<std::string> warnings;
};

/// A client that keeps the received bytes.
class Client {
 public:
  explicit Client(std::uint16_t port) : peer_(test::Peer::tcp(port)) {}

  void say(std::string_view bytes) const { EXPECT_TRUE(peer_.say(bytes)); }
  void close() { peer_.close(); }
  bool is_closed() const { return peer_.is_closed; }
  /// Returns the bytes that were received and not taken yet.
  std::string& heard() {
    peer_.hear();
    return peer_.heard;
  }
  /// Takes the next complete line, without its end. Returns false when there is none yet.
  bool take_line(std::string& line) {
    peer_.hear();
    return peer_.take_line(line);
  }
  /// Waits for a line, while the simulation runs on its own.
  std::string wait_line() { return peer_.wait_line(); }
  std::string ask_running(const std::string& line) {
    say(line + "\n");
    return wait_line();
  }

 private:
  test::Peer peer_;
};

/// Runs until `done` returns true, in steps of `seconds`, for at most 5 s of the wall clock.
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

/// Runs the simulation until the client receives a line, and returns this line.
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

/// Returns the numbers of a reply, after its first word.
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
