// SPDX-License-Identifier: MIT
#include "host/scenario/joint_dynamics.hpp"

#include <fmt/format.h>

#include "host/names.hpp"
#include "muro/base/limits.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::host {

std::vector<JointDynamics> read_joint_dynamics(MapReader& robot, Problems& problems) {
  const Node& joints = robot.map("dynamics");
  std::vector<JointDynamics> all;
  for (std::size_t i = 0; i < joints.map.size(); ++i) {
    const auto& [joint, node] = joints.map[i];
    MapReader map(node, fmt::format("`dynamics` of joint `{}` of {}", joint, robot.what()), problems);
    const auto number = [&](const char* key, double max) {
      return map.has(key) ? std::optional(map.number(key, 0, 0, max)) : std::nullopt;
    };
    JointDynamics d;
    d.joints = {joint, joints.key_locations[i]};
    d.damping = number("damping", limits::joint_resistance);
    d.friction = number("friction", limits::joint_resistance);
    d.armature = number("armature", limits::inertia);
    map.reject_unknown_keys();
    all.push_back(std::move(d));
  }
  return all;
}

void set_joint_dynamics(RobotTree& tree, const RobotTemplate& t, Problems& problems) {
  for (const JointDynamics& d : t.dynamics) {
    std::vector<std::string> names;
    bool found = false;
    for (std::size_t i = 0; i < tree.links().size(); ++i) {
      const RobotTree::FlatLink& link = tree.links()[i];
      if (link.joint < 0) continue;
      names.push_back(tree.components()[std::size_t(link.joint)].name);
      if (!detail::names_joint(d.joints.text, names.back())) continue;
      found = true;
      JointLimits limits = link.link.limits;
      limits.damping = d.damping.value_or(limits.damping);
      limits.friction = d.friction.value_or(limits.friction);
      limits.armature = d.armature.value_or(limits.armature);
      tree.set_limits(i, limits);
    }
    if (!found)
      problems.add(d.joints.location, fmt::format("`dynamics` of robot `{}` names `{}`, and there is no such joint{}",
                                                  t.name, d.joints.text, suggestion(d.joints.text, names, "it has")));
  }
}

}  // namespace muro::host
