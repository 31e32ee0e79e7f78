// SPDX-License-Identifier: MIT
// The pitch by the laws of the game (RoboCup Humanoid League, KidSize 2025): whether a ball is out or in a goal, and
// where it is put then. x points to the goal that the left team attacks, y to its left, the origin is the centre mark.
#pragma once

#include <algorithm>
#include <cmath>

#include "../common/place.hpp"

namespace soccer {

enum Team { left, right, no_team };

using examples::Point;

struct Pitch {
  double length = 9, width = 6;  ///< m, to the middle of the lines
  double goal_width = 2.6, goal_height = 1.2;
  double goal_area_length = 1, goal_area_width = 3;
  double ball_radius = 0.07;

  /// Returns the team that has scored with the whole ball behind a goal line; no_team: none.
  Team scorer(double x, double y, double z) const {
    if (!is_behind_goal_line(x) || std::abs(y) > 0.5 * goal_width || z > goal_height) return no_team;
    return x > 0 ? left : right;
  }
  bool is_behind_goal_line(double x) const { return std::abs(x) > 0.5 * length + ball_radius; }
  bool is_out(double x, double y) const { return is_behind_goal_line(x) || std::abs(y) > 0.5 * width + ball_radius; }
  /// Returns where a ball that went out at (x, y) is put: a throw-in where it crossed the line; behind a goal line a
  /// corner, or the near corner of the goal area if the attacker or nobody touched it `last`.
  Point restart(double x, double y, Team last) const {
    if (!is_behind_goal_line(x)) return {std::clamp(x, -0.5 * length, 0.5 * length), std::copysign(0.5 * width, y)};
    const Team defender = x > 0 ? right : left;
    if (last == defender) return {std::copysign(0.5 * length, x), std::copysign(0.5 * width, y)};
    return {std::copysign(0.5 * length - goal_area_length, x), std::copysign(0.5 * goal_area_width, y)};
  }
};

}  // namespace soccer
