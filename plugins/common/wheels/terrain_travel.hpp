// SPDX-License-Identifier: MIT
// Wheeled vehicles on the ground of a scene with heightmaps.
#pragma once

#include "contact_points.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "planar_motion.hpp"

namespace muro::wheels {

/// Keeps vehicles that move in their own x-y plane on the ground. This plane is that of their wheels' lowest points, so
/// a way along it is a way along the ground; for the rest see ground::Standing. Without heightmaps it does nothing.
class TerrainTravel {
 public:
  /// Adds the points of a robot. [setup]
  template <class StandingWheel>
  Range connect(const Connector& c, const RobotView& robot, const std::vector<StandingWheel>& wheels,
                std::span<const double> positions) {
    terrain_.connect(c);
    if (!follows()) return {};
    return points_.add(wheels::contact_points(c, robot, std::span<const StandingWheel>(wheels), positions));
  }

  bool follows() const { return terrain_.has_heightmaps(); }
  /// Returns the shapes of the scenery that are ground.
  std::span<const ShapeOfObject> ground() const {
    if (!follows()) return {};
    return terrain_.shapes();
  }
  /// Returns the points of a robot, those of its wheels first.
  std::span<ground::ContactPoint> contacts_of(Range robot) { return points_[robot]; }

  /// Returns the longest part (s) of a step of `dt` in which a robot that is no faster than `speed` (m/s) stays in one
  /// cell or reaches only the next.
  double longest_interval(double speed, double dt) const {
    const double cells = speed * dt / terrain_.resolution();
    return cells > 1 ? dt / std::ceil(std::min(cells, 1e3)) : dt;
  }

  /// Puts a robot that has moved from `before` to `pose` in its own plane on the ground. [step]
  void settle(Range robot, const Pose& before, Pose& pose) const {
    if (!follows() || !pose.position.allFinite()) return;
    ground::Standing(terrain_, points_[robot]).settle(before, pose);
  }

  /// Returns the velocity of a robot that moves at `v` in its own plane. [step]
  Twist in_world(Range robot, const Pose& pose, const PlanarTwist& v) const {
    if (!follows() || !pose.position.allFinite()) return wheels::in_world(pose, v);
    return ground::Standing(terrain_, points_[robot]).velocity(pose, {v.x, v.y, v.yaw_rate});
  }

 private:
  ground::Terrain terrain_;
  PackedLists<ground::ContactPoint> points_;
};

}  // namespace muro::wheels
