// SPDX-License-Identifier: MIT
// Reception of complete frames.
#pragma once

#include "shared_medium.hpp"

namespace muro::log_distance {

/// A complete frame, as receivers find it.
struct CompleteFrame {
  const Frame* frame;
  std::int64_t receiver;
  std::uint32_t radio;  ///< its sender
};

/// Data that all receptions of one step share.
struct Surroundings {
  const Channel& channel;
  std::span<const Radio> radios;
  std::span<const Vec3> places;             ///< m, positions of the radios
  std::span<const CompleteFrame> complete;  ///< complete frames of all radios
  const SpatialHash& hash;                  ///< over the positions of their senders, in this order
  const SharedMedium& medium;
  double disturbing = 0;  ///< m: distance within which the strongest transmission disturbs others
  double hearing = 0;     ///< m: distance within which the strongest transmission is received
  double now = 0;         ///< s
  std::uint64_t seed = 0;
};

/// Radio `number` processes all complete frames. Frames that it receives go to its lists, or stay on their way until
/// the signal has covered the distance. Frames that it loses are counted.
void receive(const Surroundings& s, std::uint32_t number);

}  // namespace muro::log_distance
