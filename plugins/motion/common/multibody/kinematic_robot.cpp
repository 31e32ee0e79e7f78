// SPDX-License-Identifier: MIT
#include "kinematic_robot.hpp"

#include <algorithm>
#include <string>

#include "engine_parameters.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/motion/common/kinematic_joints/moving_mass.hpp"

namespace muro::multibody {

bool KinematicRobot::is_one(const Connector& c, const RobotView& robot, const Parameters& p) {
  return p.text(base_mode.name) == "fixed" && !has_moving_mass(c, robot);
}

KinematicRobot::KinematicRobot(Connector& c, const RobotView& robot, const Parameters& p, std::uint32_t level)
    : joints_(c, robot, drive_modes_of(c, robot, p)), level_(level) {
  const ObjectId base = robot.base();
  active_level_ = c.input(base, keys::motion_level, std::uint32_t{0});
  contact_role_ = ContactRole(c, base, kinematic_world);
  c.variable(base, keys::pose, c.constant(base, keys::initial_pose).value_or(Pose{}));
  twist_ = c.variable(base, keys::twist, Twist{});
  for (const Link& link : robot.links) {
    if (link.joint != JointKind::fixed) efforts_.push_back(c.derived(link.joint_object, keys::joint_effort));
    if (!c.constant_array(link.object, keys::collision_shapes).empty())
      contact_wrenches_.push_back(c.derived(link.object, keys::contact_wrench));
  }
}

void KinematicRobot::take_over() const {
  contact_role_.take_over();
  *twist_ = Twist{};
}

void KinematicRobot::step(double dt) const {
  if (!is_active()) return;
  joints_.move(dt);
  for (const Out<double>& effort : efforts_) *effort = 0;
  for (const Out<Wrench>& wrench : contact_wrenches_) *wrench = Wrench{};
}

void tell_of(Connector& c, const std::vector<const KinematicRobot*>& robots) {
  std::vector<std::string> names;
  bool still = false;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const RobotView& view = *c.items()[i].robot;
    const auto moves = [](const Link& link) { return link.joint != JointKind::fixed; };
    if (!robots[i] || std::none_of(view.links.begin(), view.links.end(), moves)) continue;
    names.emplace_back(view.name);
    still = still || robots[i]->stands_still();
  }
  tell_of_robots_without_forces(c, names, still);
}

}  // namespace muro::multibody
