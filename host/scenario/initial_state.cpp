// SPDX-License-Identifier: MIT
#include "host/scenario/initial_state.hpp"

#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Whether the model gives a start position for the joint.
bool has_start(const World& world, ObjectId joint) {
  return joint != no_object && world.find_constant(joint, keys::initial_joint_position);
}

}  // namespace

std::string name_within(const World& world, const RobotView& robot, ObjectId object) {
  return world.object_name(object).substr(robot.name.size() + 1);
}

void set_initial_state(World& world, const RobotTemplate& t, const RobotView& robot, const StartPose& start) {
  world.set(robot.base(), keys::initial_twist, Twist{t.linear_velocity, t.angular_velocity});
  for (std::size_t i = 0; i < robot.links.size(); ++i)
    if (const Link& link = robot.links[i];
        link.mimic < 0 && (start.positions[i] != 0 || has_start(world, link.joint_object)))
      world.set(link.joint_object, keys::initial_joint_position, start.positions[i]);
}

}  // namespace muro::host
