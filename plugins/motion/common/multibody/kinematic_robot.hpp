// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "plugins/motion/common/kinematic_joints/kinematic_joints.hpp"
#include "plugins/motion/common/motion/contact_role.hpp"

namespace muro::multibody {

/// A robot on a fixed base whose moving links have no mass, so that no engine can move it: its joints follow their
/// targets within limits. In each world it is a body that no force moves.
class KinematicRobot {
 public:
  /// Whether a robot with these parameters is one. [setup]
  static bool is_one(const Connector& c, const RobotView& robot, const Parameters& p);

  /// `level`: the motion.level at which this motion moves the robot. [setup]
  KinematicRobot(Connector& c, const RobotView& robot, const Parameters& p, std::uint32_t level);

  /// Whether some of its joints are in modes in which only forces move them.
  bool stands_still() const { return joints_.stands_still(); }
  /// Whether it is this motion that moves the robot.
  bool is_active() const { return *active_level_ == level_; }
  /// This motion moves the robot from now on.
  void take_over() const;
  /// Carries it on by `dt` (s), if it is this motion that moves it. Throws Error for a target that is not finite.
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

/// Tells the user which robots are such ones and have joints. `robots`: one an item; null for others. [setup]
void tell_of(Connector& c, const std::vector<const KinematicRobot*>& robots);

}  // namespace muro::multibody
