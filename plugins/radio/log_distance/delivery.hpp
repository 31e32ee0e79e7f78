// SPDX-License-Identifier: MIT
// Moves messages that have arrived to the lists that control code reads.
#pragma once

#include "radio.hpp"

namespace muro::log_distance {

/// A message that a radio receives. `payload` points to its bytes.
struct Incoming {
  double received;  ///< s
  double sent;      ///< s
  double rssi;      ///< dBm
  std::int64_t number;
  std::int32_t from;
  std::uint32_t size;
  const Payload* payload;
};

/// Lists the messages that have arrived by `now` (s) in order of arrival: new ones from `incoming`, and older ones that
/// were on their way. The other messages of `incoming` are on their way from now on.
void deliver(const Radio& r, std::span<const Incoming> incoming, double now);

/// Removes messages from the list of received messages when they are older than `keep`.
void forget_messages(const Radio& r, double now);

}  // namespace muro::log_distance
