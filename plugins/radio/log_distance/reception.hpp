// SPDX-License-Identifier: MIT
// What a radio receives of the frames that are complete.
#pragma once

#include "shared_medium.hpp"

namespace muro::log_distance {

/// All that receptions of one step have in common.
struct Surroundings {
  const Channel& channel;
  std::span<const Radio> radios;
  std::span<const Vec3> places;            ///< m, of the radios
  std::span<const std::uint32_t> members;  ///< radios that may be heard
  const SpatialHash& hash;                 ///< over their places, in this order
  const SharedMedium& medium;
  double disturbing = 0;  ///< m: so far the strongest disturbs others
  double hearing = 0;     ///< m: so far the strongest is received
  double now = 0;         ///< s
  std::uint64_t seed = 0;
};

/// Removes messages from the list of those that have come that have been there for long.
void forget_messages(const Radio& r, double now);

/// Radio `number` looks at all frames that are complete: those that it receives go to its lists, or stay on their way
/// until the signal has covered the distance; those that it loses are counted.
void receive(const Surroundings& s, std::uint32_t number);

}  // namespace muro::log_distance
