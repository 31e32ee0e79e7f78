// SPDX-License-Identifier: MIT
// From the way to the lists that control code reads.
#pragma once

#include "radio.hpp"

namespace muro::log_distance {

/// A message that a radio receives, where its bytes lie.
struct Incoming {
  double received;  ///< s
  double sent;      ///< s
  double rssi;      ///< dBm
  std::int64_t number;
  std::int32_t from;
  std::uint32_t size;
  const Payload* payload;
};

/// Lists what has come by `now` (s), in the order of its coming: of `incoming`, which is new, and of what was on its
/// way before. The rest of `incoming` is then on its way.
void deliver(const Radio& r, std::span<const Incoming> incoming, double now);

/// Removes messages from the list of those that have come that have been there for long.
void forget_messages(const Radio& r, double now);

}  // namespace muro::log_distance
