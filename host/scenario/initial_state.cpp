// SPDX-License-Identifier: MIT
#include "host/scenario/initial_state.hpp"

#include "muro/vocabulary.hpp"

namespace muro::host {

std::string name_within(const World& world, const RobotView& robot, ObjectId object) {
  return world.object_name(object).substr(robot.name.size() + 1);
}

void set_initial_state(World& world, const RobotTemplate& t, const RobotView& robot, const StartPose& start) {
  world.set(robot.base(), keys::initial_twist, Twist{t.linear_velocity, t.angular_velocity});
  for (std::size_t i = 0; i < robot.links.size(); ++i)
    if (const Link& link = robot.links[i]; link.mimic < 0 && start.positions[i] != 0)
      world.set(link.joint_object, keys::initial_joint_position, start.positions[i]);
}

}  // namespace muro::host
