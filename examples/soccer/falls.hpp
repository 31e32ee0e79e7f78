// SPDX-License-Identifier: MIT
// Detects falls of a player by the tilt of its trunk. A player that gets up from its back sits upright on the way, and
// then bends forward over its feet: this is no second fall. So a fall ends when the trunk has been upright for a while.
#pragma once

#include <cstdint>

namespace soccer {

/// Watches one player.
class FallWatch {
 public:
  /// `up`: the trunk's axis z along "up", 1: upright; `h`: s since the last call. Returns true once for each fall.
  bool has_fallen(double up, double h) {
    lying_ = up > lies ? 0 : lying_ + h;
    upright_ = up > stands ? upright_ + h : 0;
    if (upright_ > time_to_stand) is_down_ = 0;
    if (is_down_ || lying_ <= time_to_lie) return false;
    is_down_ = 1;
    return true;
  }

 private:
  static constexpr double lies = 0.5;           // `up` below this: the player lies
  static constexpr double time_to_lie = 0.5;    // s: a player that lies so long has fallen
  static constexpr double stands = 0.95;        // `up` above this: the trunk is upright, as in a walk
  static constexpr double time_to_stand = 1.0;  // s: upright so long, it stands; it sits upright for 0.6 s on the way

  double lying_ = 0, upright_ = 0;  // s
  std::int64_t is_down_ = 0;        // 1: its fall has been counted, and it has not stood since
};

}  // namespace soccer
