// SPDX-License-Identifier: MIT
// A stream that answers each message with itself, for tests.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>

#include "muro/algorithm.hpp"
#include "plugins/controller/common/stream/fake_host_testing.hpp"
#include "plugins/controller/common/stream/stream.hpp"
#include "tests/support/peer.hpp"

namespace muro::stream {

using test::Peer;

inline Address address_of(const Connector& connector, const std::vector<std::string_view>& texts,
                          std::uint32_t item = 0) {
  return read_address(connector, item, texts);
}

/// An event of a Stream, with its own copy of the bytes.
struct Heard {
  Event::Kind kind;
  std::uint32_t client;
  std::string bytes;
  std::int64_t time;
  bool operator==(const Heard&) const = default;
};

/// A simulation that has only a stream, with steps of a millisecond.
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
  /// Steps until `done` returns true. Returns false when this takes longer than 5 s.
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

inline std::size_t open_descriptors() {
  std::size_t count = 0;
  for (int fd = 0; fd < 4096; ++fd) count += ::fcntl(fd, F_GETFD) >= 0 ? 1 : 0;
  return count;
}

}  // namespace muro::stream
