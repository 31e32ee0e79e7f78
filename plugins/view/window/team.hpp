// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "body_poses.hpp"

namespace muro::view {

/// Robots that the window follows on its own: those that have moved away from their start, or all robots while none has
/// moved. Shadows are left out.
class Team {
 public:
  /// Takes the robots, and the links of all robots from `bodies`. [setup]
  void connect(const Connector& c, const BodyPoses& bodies) {
    robots_.resize(c.robots().size());
    for (const RobotView* robot : c.robots()) {
      Robot& r = robots_[index_of(robot->id)];
      r.is_shadow = c.constant(robot->base(), keys::shadow_of).has_value();
      r.start = c.constant(robot->base(), keys::initial_pose).value_or(Pose{}).position;
    }
    links_ = bodies.links();
  }

  struct Ball {
    Vec3 middle = Vec3::Zero();  ///< m
    double radius = 0;           ///< m: contains the origins of the links
  };
  /// Returns a ball around the followed robots at their present poses.
  Ball bounds() {
    bool any = false;
    for (const BodyPoses::Body& b : links_) {
      if (!b.is_base) continue;
      Robot& r = robots_[std::size_t(b.robot)];
      r.has_moved = !r.is_shadow && (b.pose->position - r.start).squaredNorm() > moved * moved;
      any = any || r.has_moved;
    }
    Vec3 low = Vec3::Constant(beyond), high = -low;
    for (const BodyPoses::Body& b : links_) {
      const Robot& r = robots_[std::size_t(b.robot)];
      if (r.is_shadow || (any && !r.has_moved) || !(b.pose->position.cwiseAbs().maxCoeff() < beyond)) continue;
      low = low.cwiseMin(b.pose->position);
      high = high.cwiseMax(b.pose->position);
    }
    if (!((high - low).minCoeff() >= 0)) return {};
    return {0.5 * (low + high), 0.5 * (high - low).norm()};
  }
  bool empty() const { return robots_.empty(); }

 private:
  static constexpr double moved = 0.1;   ///< m: a robot that is nearer to its start has not moved
  static constexpr double beyond = 1e6;  ///< m: links farther away are not followed
  struct Robot {
    Vec3 start = Vec3::Zero();
    bool is_shadow = false, has_moved = false;
  };
  std::vector<Robot> robots_;  ///< by number
  std::span<const BodyPoses::Body> links_;
};

}  // namespace muro::view
