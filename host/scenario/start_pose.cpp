// SPDX-License-Identifier: MIT
#include "host/scenario/start_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host/names.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

const std::string& name_of(const RobotTree& tree, const RobotTree::FlatLink& link) {
  return tree.components()[std::size_t(link.joint)].name;
}

const char* unit_of(const Link& link) { return link.joint == JointKind::revolute ? "rad" : "m"; }

std::string range_of(const Link& link) {
  return fmt::format("{:g} to {:g} {}", link.limits.lower, link.limits.upper, unit_of(link));
}

/// Position (rad or m) of a joint at the start in the model; 0 when it gives none.
double position_in_model(const RobotTree& tree, const RobotTree::FlatLink& link) {
  double position = 0;
  if (link.joint < 0) return position;
  for (const RobotTree::Constant& c : tree.components()[std::size_t(link.joint)].constants)
    if (c.key.name == keys::initial_joint_position.name && c.data.size() == sizeof position)
      std::memcpy(&position, c.data.data(), sizeof position);
  return position;
}

/// Sets the positions that the scenario gives.
void set_given(const RobotTree& tree, const RobotTemplate& t, std::vector<double>& positions,
               std::vector<bool>& is_given, Problems& problems) {
  const auto& links = tree.links();
  for (const auto& given : t.joints) {
    const Name& joint = given.first;
    const double position = given.second;
    const auto found = std::find_if(links.begin(), links.end(), [&](const RobotTree::FlatLink& l) {
      return l.joint >= 0 && name_of(tree, l) == joint.text;
    });
    if (found == links.end()) {
      std::vector<std::string> names;
      for (const RobotTree::FlatLink& l : links)
        if (l.joint >= 0) names.push_back(name_of(tree, l));
      problems.add(joint.location, fmt::format("robot `{}` has no joint `{}`{}", t.name, joint.text,
                                               suggestion(joint.text, names, "it has")));
      continue;
    }
    const JointLimits& limits = found->link.limits;
    if (position < limits.lower || position > limits.upper)
      problems.add(joint.location, fmt::format("joint `{}` of robot `{}` starts at {:g}, outside of its limits {}",
                                               joint.text, t.name, position, range_of(found->link)));
    const auto i = std::size_t(found - links.begin());
    positions[i] = position;
    is_given[i] = true;
  }
}

}  // namespace

StartPose start_pose(const RobotTree& tree, const RobotTemplate& t, Problems& problems) {
  const auto& links = tree.links();
  StartPose out;
  out.positions.assign(links.size(), 0);
  std::vector<bool> is_given(links.size());
  set_given(tree, t, out.positions, is_given, problems);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& l = links[i].link;
    if (l.joint == JointKind::fixed || l.mimic >= 0 || is_given[i] || !(l.limits.lower <= l.limits.upper)) continue;
    const double modelled = position_in_model(tree, links[i]);
    out.positions[i] = std::clamp(modelled, l.limits.lower, l.limits.upper);
    if (std::abs(out.positions[i] - modelled) > 1e-6)
      out.clamped.push_back(fmt::format("`{}` at {:g} ({})", name_of(tree, links[i]), out.positions[i], range_of(l)));
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    if (const Link& l = links[i].link; l.mimic >= 0)
      out.positions[i] = l.mimic_offset + l.mimic_multiplier * out.positions[std::size_t(l.mimic)];
  return out;
}

}  // namespace muro::host
