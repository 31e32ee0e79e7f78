// SPDX-License-Identifier: MIT
#include "link_motion.hpp"

#include <algorithm>
#include <string>

#include "muro/toolkit/mass_properties.hpp"

namespace muro::link_motion {

JointMotion::JointMotion(Connector& c, const RobotView& robot, std::uint32_t link, double start, Order order) {
  const Link& own = robot.links[link];
  object_ = own.joint_object;
  if (own.mimic >= 0 && !c.is_used(own.joint_object, keys::joint_position, usage::variable)) {
    object_ = robot.links[std::size_t(own.mimic)].joint_object;
    multiplier_ = own.mimic_multiplier;
    offset_ = own.mimic_offset;
    start = (start - offset_) / (multiplier_ == 0 ? 1 : multiplier_);
  }
  position_ = c.input(object_, keys::joint_position, start);
  if (order >= Order::twist) velocity_ = c.input(object_, keys::joint_velocity, 0.0);
  if (order >= Order::acceleration) acceleration_ = c.input(object_, keys::joint_acceleration, 0.0);
}

void JointMotion::check_acceleration(const Connector& c) const {
  const auto is_written = [&](const KeyInfo& key) {
    return c.is_used(object_, key, usage::write) || c.is_used(object_, key, usage::optional_output) ||
           c.is_used(object_, key, usage::derived) || c.is_used(object_, key, usage::variable);
  };
  const bool moves = is_written(keys::joint_position) || is_written(keys::joint_velocity);
  if (moves && !c.is_used(object_, keys::joint_acceleration, usage::variable))
    throw Error("no motion moves the joint `" + std::string(c.object_name(object_)) +
                "`, so the acceleration of what it carries is not known; let a motion move it");
}

LinkMotion::LinkMotion(Connector& c, const RobotView& robot, std::uint32_t link, const Pose& origin, Order order)
    : robot_(&robot), origin_(origin) {
  base_pose_ = c.read(robot.base(), keys::pose);
  if (order >= Order::twist) twist_ = c.read(robot.base(), keys::twist);
  if (order >= Order::acceleration) acceleration_ = c.input(robot.base(), keys::acceleration, Twist{});
  const std::vector<double> start = initial_joint_positions(c, robot);
  for (std::uint32_t i = link; i > 0; i = std::uint32_t(robot.links[i].parent)) {
    const Link& l = robot.links[i];
    if (l.joint == JointKind::fixed) {
      (joints_.empty() ? origin_ : joints_.back().origin) =
          l.origin * (joints_.empty() ? origin_ : joints_.back().origin);
      continue;
    }
    joints_.push_back({l.origin, l.joint, l.axis, JointMotion(c, robot, i, start[i], order)});
  }
  std::reverse(joints_.begin(), joints_.end());
  is_at_origin_ = origin_.position.isZero(0) && origin_.orientation.coeffs() == Quat::Identity().coeffs();
}

void LinkMotion::check(const Connector& c) const {
  if (!acceleration_) return;
  if (!c.is_used(robot_->base(), keys::acceleration, usage::variable))
    throw Error("no motion of `" + std::string(robot_->name) +
                "` tells the acceleration of its base, so there is nothing to measure; give the robot a motion that "
                "writes `acceleration` (`muro properties` names them)");
  for (const Joint& j : joints_) j.motion.check_acceleration(c);
}

}  // namespace muro::link_motion
