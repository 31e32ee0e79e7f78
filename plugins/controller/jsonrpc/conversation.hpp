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

/// The condition that a request in progress waits for.
struct Pending {
  enum class Until : std::uint8_t {
    nothing,
    effects,  ///< all changes that it has requested of the simulation are done
    pause,    ///< the run is paused, at `time` or later
    instant,  ///< the first step of this controller at `time` or later
  };
  Until until = Until::nothing;
  std::int64_t time = 0;      ///< ns
  std::uint32_t effects = 0;  ///< number of changes that are not done yet
  std::string problem;        ///< reason of the first refused change
};

/// One client with its unanswered input. Its requests are carried out one after the other; each begins when the one
/// before it has been answered.
struct Conversation {
  static constexpr std::size_t most_lines = 4096;     ///< limit of waiting lines
  static constexpr std::size_t most_bytes = 8 << 20;  ///< limit of bytes in these lines
  static constexpr std::size_t most_subscriptions = 64;

  static constexpr int most_failures = 3;  ///< attempts to give the token

  std::uint32_t client = 0;
  bool is_trusted = true;  ///< there is no token, or the client has given it
  int failures = 0;        ///< number of wrong tokens
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
  std::deque<std::string> lines;   ///< lines that are not read yet
  std::size_t bytes = 0;           ///< bytes in these lines
  std::optional<Message> message;  ///< message that is being carried out
  Pending pending;
  std::uint32_t requests = 0;  ///< count so far; tickets of the present request contain it
  bool is_active = false;      ///< a caller on the stack is carrying out its requests
  bool is_held = false;        ///< reading from it has stopped, since much of it waits
  bool is_over = false;        ///< it is being disconnected: nothing more is done for it
  bool has_left = false;       ///< it sends nothing any more, but may read outstanding replies
  bool is_idle() const { return is_over || (lines.empty() && !message); }

  std::vector<Subscription> subscriptions;
  std::uint32_t last_subscription = 0;  ///< numbers count up from 1
};

}  // namespace muro::jsonrpc
