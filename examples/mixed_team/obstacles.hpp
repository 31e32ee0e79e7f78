// SPDX-License-Identifier: MIT
// Obstacles around a robot, and the free way along a heading. In its own axes: x forward, y left, m, rad.
#pragma once

#include <algorithm>
#include <cmath>

#include "../common/angle.hpp"
#include "../common/limited_list.hpp"
#include "../common/place.hpp"

namespace mixed_team {

using examples::Point;
using examples::wrapped;

class Obstacles {
 public:
  explicit Obstacles(double radius) : radius_(radius) {}  ///< m: radius of the robot as a disc

  /// Adds a disc. Discs beyond the capacity are left out.
  void add(const Point& p, double radius) { discs_.add({p, radius + radius_}); }
  /// Returns how far the robot gets straight on along a heading, m, at most `horizon`. A disc that it is already in
  /// stops it only if it would go deeper.
  double free_way(double heading, double horizon) const {
    double way = horizon;
    for (const Disc& disc : discs_.all()) {
      const Point p = turned(disc.at, -heading);
      const double rest = disc.radius * disc.radius - p.y * p.y;
      if (p.x <= 0 || rest <= 0) continue;
      const double reach = p.x - std::sqrt(rest);
      if (reach < 0 && p.x < 0.4 * disc.radius) continue;  // the disc is beside it
      way = std::min(way, std::max(0.0, reach));
    }
    return way;
  }

  /// A heading and the free way along it (m). It leads best to a goal in a direction, in the manner of the vector field
  /// histogram (Borenstein and Koren, IEEE Trans. Robotics and Automation 7(3), 1991).
  struct Way {
    double heading = 0, free = 0;
  };
  /// `last`: the heading chosen last; a robot that keeps to it passes an obstacle on one side.
  Way best(double wanted, double distance, double last) const {
    constexpr int headings = 30;    // to either side
    constexpr double widest = 2.2;  // rad
    const double horizon = std::min(2.5, std::max(0.3, distance));
    Way way;
    double most_points = -1e9;
    for (int i = -headings; i <= headings; ++i) {
      const double heading = widest * i / headings, free = free_way(heading, horizon);
      const double points =
          free / horizon - 0.4 * std::abs(wrapped(heading - wanted)) - 0.15 * std::abs(wrapped(heading - last));
      if (points > most_points) most_points = points, way = {heading, free};
    }
    return way;
  }

 private:
  struct Disc {
    Point at;
    double radius = 0;
  };
  double radius_;
  examples::LimitedList<Disc, 256> discs_;
};

}  // namespace mixed_team
