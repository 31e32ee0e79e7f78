// SPDX-License-Identifier: MIT
// What a radio receives of the frames that are complete.
#pragma once

#include "shared_medium.hpp"

namespace muro::log_distance {

/// A frame that is complete, as receivers find it.
struct CompleteFrame {
  const Frame* frame;
  std::int64_t receiver;
  std::uint32_t radio;  ///< its sender
};

/// All that receptions of one step have in common.
struct Surroundings {
  const Channel& channel;
  std::span<const Radio> radios;
  std::span<const Vec3> places;             ///< m, of the radios
  std::span<const CompleteFrame> complete;  ///< of all radios
  const SpatialHash& hash;                  ///< over the places of their senders, in this order
  const SharedMedium& medium;
  double disturbing = 0;  ///< m: so far the strongest disturbs others
  double hearing = 0;     ///< m: so far the strongest is received
  double now = 0;         ///< s
  std::uint64_t seed = 0;
};

/// Radio `number` looks at all frames that are complete: those that it receives go to its lists, or stay on their way
/// until the signal has covered the distance; those that it loses are counted.
void receive(const Surroundings& s, std::uint32_t number);

}  // namespace muro::log_distance
