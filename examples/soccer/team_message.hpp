// SPDX-License-Identifier: MIT
// Messages that the players of a team send each other several times a second: the numbers of `team.message`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "../common/place.hpp"

namespace soccer {

using examples::Point;

/// Activity of a player. The others leave the ball to a player that goes for it.
enum Role : std::int64_t { waits, searches, goes_for_ball, keeps_place };

struct TeamMessage {
  std::int64_t number = 0;  ///< number of the player
  Role role = waits;
  double cost = 0;  ///< m: length of the way to where the ball can be kicked from
  Point me;         ///< m, on the field
  Point ball;       ///< m, on the field
  double age = 0;   ///< s: since somebody saw the ball there

  static constexpr std::size_t size = 8;
  static constexpr const char* units = "1, 1, m, m, m, m, m, s";

  static TeamMessage from(std::span<const double> n) {
    return {std::int64_t(n[0]), Role(std::int64_t(n[1])), n[2], {n[3], n[4]}, {n[5], n[6]}, n[7]};
  }
  void write(std::span<double> n) const {
    n[0] = double(number), n[1] = double(role), n[2] = cost;
    n[3] = me.x, n[4] = me.y, n[5] = ball.x, n[6] = ball.y, n[7] = age;
  }
};

}  // namespace soccer
