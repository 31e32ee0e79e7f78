// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "plugins/motion/common/kinematic_joints/kinematic_joints.hpp"
#include "plugins/motion/common/motion/contact_role.hpp"

namespace muro::multibody {

/// A robot on a fixed base whose moving links have no mass, so no engine can move it. Its joints follow their targets
/// within limits. In each world it is a body that no force moves.
class KinematicRobot {
 public:
  /// Whether a robot with these parameters is a kinematic robot. [setup]
  static bool is_one(const Connector& c, const RobotView& robot, const Parameters& p);

  /// `level`: the motion.level at which this motion moves the robot. [setup]
  KinematicRobot(Connector& c, const RobotView& robot, const Parameters& p, std::uint32_t level);

  /// Whether some of its joints are in modes in which only forces move them.
  bool stands_still() const { return joints_.stands_still(); }
  /// Whether this motion moves the robot.
  bool is_active() const { return *active_level_ == level_; }
  /// Lets this motion move the robot from now on.
  void take_over() const;
  /// Moves the robot by `dt` (s), if this motion moves it. Throws Error for a target that is not finite.
  void step(double dt) const;

 private:
  KinematicJoints joints_;
  std::uint32_t level_;
  In<std::uint32_t> active_level_;
  ContactRole contact_role_;
  Out<Twist> twist_;
  std::vector<Out<double>> efforts_;
  std::vector<Out<Wrench>> contact_wrenches_;
};

/// Logs which robots are kinematic and have joints. `robots`: one per item, null for other robots. [setup]
void tell_of(Connector& c, const std::vector<const KinematicRobot*>& robots);

}  // namespace muro::multibody
