// SPDX-License-Identifier: MIT
// Landmarks of a field by which a player finds its place: posts of goals and lines. The origin is the centre mark, x
// points to a goal, y to the left of it. Defaults: KidSize (RoboCup Humanoid League, rules of 2025), as in field.sdf.
#pragma once

#include <algorithm>
#include <array>

#include "../common/place.hpp"

namespace soccer {

using examples::Point;

struct Landmarks {
  double length = 8.95, width = 5.95;  ///< m: between the middles of goal lines, and of touch lines
  double goal_width = 2.7;             ///< m: between the axes of the posts of a goal
  double goal_depth = 0.6;             ///< m: depth of its frame on the ground, behind the goal line
  double goal_area_length = 0.95, goal_area_width = 2.95;
  double penalty_area_length = 1.95, penalty_area_width = 4.95;
  double penalty_mark = 1.475;  ///< m: from the middle of the goal line
  double circle = 0.75;         ///< m: radius

  /// Returns the axes of all four posts on the ground (m).
  std::array<Point, 4> posts() const {
    const double x = 0.5 * length, y = 0.5 * goal_width;
    return {Point{x, y}, Point{x, -y}, Point{-x, y}, Point{-x, -y}};
  }
  /// Returns the point (m) nearest to `p` on the middles of all lines, on marks, and on the goals' frames on the
  /// ground. All of these are symmetric about both axes.
  Point nearest_on_lines(const Point& p) const {
    const Point corner{std::abs(p.x), std::abs(p.y)};  // in the quarter where x and y are positive
    const double goal_line = 0.5 * length, touch_line = 0.5 * width;
    const double goal_area = goal_line - goal_area_length, penalty_area = goal_line - penalty_area_length;
    Nearest nearest{corner, {}};
    nearest.try_segment({0, 0}, {0, touch_line});
    nearest.try_segment({0, touch_line}, {goal_line, touch_line});
    nearest.try_segment({goal_line, 0}, {goal_line, touch_line});
    nearest.try_segment({goal_area, 0}, {goal_area, 0.5 * goal_area_width});
    nearest.try_segment({goal_area, 0.5 * goal_area_width}, {goal_line, 0.5 * goal_area_width});
    nearest.try_segment({penalty_area, 0}, {penalty_area, 0.5 * penalty_area_width});
    nearest.try_segment({penalty_area, 0.5 * penalty_area_width}, {goal_line, 0.5 * penalty_area_width});
    nearest.try_segment({goal_line, 0.5 * goal_width}, {goal_line + goal_depth, 0.5 * goal_width});
    nearest.try_segment({goal_line + goal_depth, 0}, {goal_line + goal_depth, 0.5 * goal_width});
    nearest.try_point({goal_line - penalty_mark, 0});
    const double from_centre = corner.norm();
    if (from_centre > 0) nearest.try_point((circle / from_centre) * corner);
    return {std::copysign(nearest.best.x, p.x), std::copysign(nearest.best.y, p.y)};
  }

 private:
  struct Nearest {
    Point to;
    Point best;
    double distance = 1e9;  ///< m

    void try_point(const Point& p) {
      const double d = (p - to).norm();
      if (d < distance) distance = d, best = p;
    }
    /// Tries a segment along x or y, from the smaller to the greater coordinate.
    void try_segment(const Point& a, const Point& b) {
      try_point({std::clamp(to.x, a.x, b.x), std::clamp(to.y, a.y, b.y)});
    }
  };
};

}  // namespace soccer
