// SPDX-License-Identifier: MIT
#include "host/scenario/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/names.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

void set_joint_position(World& world, const RobotTemplate& t, const RobotView& robot, const Name& joint,
                        double position, Problems& problems) {
  const ObjectId object = world.find_object(fmt::format("{}/{}", robot.name, joint.text));
  const bool is_joint = object != no_object && std::any_of(robot.links.begin(), robot.links.end(),
                                                           [&](const Link& l) { return l.joint_object == object; });
  if (is_joint) return world.set(object, keys::initial_joint_position, position);
  std::vector<std::string> names;
  for (const Link& link : robot.links)
    if (link.joint_object != no_object) names.push_back(name_within(world, robot, link.joint_object));
  problems.add(joint.location, fmt::format("robot `{}` has no joint `{}`{}", t.name, joint.text,
                                           suggestion(joint.text, names, "it has")));
}

}  // namespace

std::string name_within(const World& world, const RobotView& robot, ObjectId object) {
  return world.object_name(object).substr(robot.name.size() + 1);
}

void set_initial_state(World& world, const RobotTemplate& t, const RobotView& robot, Problems& problems) {
  world.set(robot.base(), keys::initial_twist, Twist{t.linear_velocity, t.angular_velocity});
  for (const auto& [joint, position] : t.joints) set_joint_position(world, t, robot, joint, position, problems);
}

}  // namespace muro::host
