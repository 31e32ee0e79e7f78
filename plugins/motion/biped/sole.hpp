// SPDX-License-Identifier: MIT
// The part of a foot that can touch the ground.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "muro/geometry.hpp"

namespace muro::biped {

/// A corner, a ball or the rim of a disc, in the frame of the foot.
struct SolePoint {
  Vec3 center = Vec3::Zero();  ///< m
  double radius = 0;           ///< m: radius of a ball
  double rim = 0;              ///< m: radius of a disc about `axis`
  Vec3 axis = Vec3::UnitZ();   ///< unit

  bool operator==(const SolePoint&) const = default;
};

/// Convex hull of these points. It stands on one side: a face, an edge or, for a ball, none.
class Sole {
 public:
  enum class Side : std::uint8_t { none, edge, face };

  Sole() = default;
  /// Finds the side on which the sole stands. The sole comes down on level ground with `down` (unit, frame of the foot)
  /// downwards. It tips about what touches, by the smaller angle first, until a side lies on the ground. `points`: at
  /// least one.
  Sole(std::vector<SolePoint> points, const Vec3& down);

  bool operator==(const Sole&) const = default;
  Side side() const { return side_; }
  /// Normal of its face, unit, out of the sole; in the frame of the foot.
  const Vec3& normal() const { return normal_; }

  /// Returns the least value of up . x over the sole (m). `up`: unit, in the frame of the foot.
  double lowest(const Vec3& up) const {
    double least = up.dot(points_.front().center) - reach(points_.front(), up);
    for (std::size_t i = 1; i < points_.size(); ++i)
      least = std::min(least, up.dot(points_[i].center) - reach(points_[i], up));
    return least;
  }
  /// Returns the lowest point of the sole (m).
  Vec3 lowest_point(const Vec3& up) const;

  /// Returns the smallest turn, in the axes of the world, that lays the side on a plane. `foot`: orientation of the
  /// foot; `normal`: of the plane, unit.
  Quat flush_turn(const Quat& foot, const Vec3& normal) const;

 private:
  static double reach(const SolePoint& p, const Vec3& up) {
    if (p.rim == 0) return p.radius;
    return p.radius + p.rim * up.cross(p.axis).norm();  // 1 - cos^2 would lose half of the digits for a flat disc
  }

  std::vector<SolePoint> points_;
  Side side_ = Side::none;
  Vec3 normal_ = -Vec3::UnitZ();  ///< normal of the face
  Vec3 edge_ = Vec3::UnitX();     ///< direction of the edge, unit
};

}  // namespace muro::biped
