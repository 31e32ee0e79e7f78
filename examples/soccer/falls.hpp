// SPDX-License-Identifier: MIT
// When a player has fallen, by how its trunk is tilted. Who gets up from its back sits upright on the way, and then
// bends forward over its feet: that is no second fall. So a fall ends when the trunk has been upright for a while.
#pragma once

#include <cstdint>

namespace soccer {

/// Of one player.
class FallWatch {
 public:
  /// `up`: of the trunk's axis z along "up", 1: upright; `h`: s, since the last call. True once for each fall.
  bool has_fallen(double up, double h) {
    lying_ = up > lies ? 0 : lying_ + h;
    upright_ = up > stands ? upright_ + h : 0;
    if (upright_ > time_to_stand) is_down_ = 0;
    if (is_down_ || lying_ <= time_to_lie) return false;
    is_down_ = 1;
    return true;
  }

 private:
  static constexpr double lies = 0.5;           // of `up`: below, the player lies
  static constexpr double time_to_lie = 0.5;    // s: so long, and it has fallen
  static constexpr double stands = 0.95;        // of `up`: above, the trunk is upright, as in a walk
  static constexpr double time_to_stand = 1.0;  // s: so long, and it stands; who gets up sits upright for 0.6 s

  double lying_ = 0, upright_ = 0;  // s
  std::int64_t is_down_ = 0;        // its fall has been counted, and it has not stood since
};

}  // namespace soccer
