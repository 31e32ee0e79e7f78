// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "message.hpp"
#include "subscription.hpp"

namespace muro::jsonrpc {

/// What the request that a client waits for is waiting for itself.
struct Pending {
  enum class Until : std::uint8_t {
    nothing,
    effects,  ///< all that it has asked of the simulation is done
    pause,    ///< the run is paused, at `time` or later
    instant,  ///< the first step of this controller at `time` or later
  };
  Until until = Until::nothing;
  std::int64_t time = 0;      ///< ns
  std::uint32_t effects = 0;  ///< that are not done yet
  std::string problem;        ///< the first of those that were refused
};

/// One client with what it has said. Its requests are carried out one after the other, each when the one before it has
/// been answered.
struct Conversation {
  static constexpr std::size_t most_lines = 4096;     ///< that wait
  static constexpr std::size_t most_bytes = 8 << 20;  ///< in those lines
  static constexpr std::size_t most_subscriptions = 64;

  static constexpr int most_failures = 3;  ///< to say the token

  std::uint32_t client = 0;
  bool is_trusted = true;  ///< there is no token, or it has said it
  int failures = 0;        ///< to say it
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
  std::deque<std::string> lines;   ///< not looked at yet
  std::size_t bytes = 0;           ///< in those
  std::optional<Message> message;  ///< that is being carried out
  Pending pending;
  std::uint32_t requests = 0;  ///< so far: tickets of the present one have its number
  bool is_active = false;      ///< its requests are being carried out further up the stack
  bool is_held = false;        ///< it is not read from, since much of it waits
  bool is_over = false;        ///< it is being disconnected: nothing more is done for it
  bool has_left = false;       ///< it says nothing any more, but may read the replies to what it has said
  bool is_idle() const { return is_over || (lines.empty() && !message); }

  std::vector<Subscription> subscriptions;
  std::uint32_t last_subscription = 0;  ///< numbers count up from 1
};

}  // namespace muro::jsonrpc
