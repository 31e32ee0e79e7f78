// SPDX-License-Identifier: MIT
#include "host/model_check/model_facts.hpp"

#include <algorithm>
#include <cmath>

#include "host/constants.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// "joint" of "robot/joint".
std::string name_in(const RobotView& robot, const World& world, ObjectId object) {
  const std::string& name = world.object_name(object);
  return name.size() > robot.name.size() + 1 ? name.substr(robot.name.size() + 1) : name;
}

/// Whether an algorithm writes a velocity or position that the joint is to follow.
bool is_driven(const World& world, ObjectId joint) {
  const auto is_written = [&](const KeyInfo& key) {
    const Slot* const slot = world.store().find(joint, key.name);
    return slot && slot->writer();
  };
  return is_written(keys::joint_velocity_target) || is_written(keys::joint_position_target);
}

}  // namespace

ModelFacts model_facts(const World& world, const RobotView& robot, const RobotTemplate& robots) {
  ModelFacts facts;
  facts.links = robot.links.size();
  std::vector<bool> moves(robot.links.size());
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    const double mass = constant(world, link.object, keys::inertial, Inertia{}).mass;
    facts.mass += mass;
    facts.has_collision_shapes =
        facts.has_collision_shapes || !constants(world, link.object, keys::collision_shapes).empty();
    if (i == 0) continue;
    moves[i] = link.joint != JointKind::fixed || moves[std::size_t(link.parent)];
    if (moves[i]) {
      ++facts.moving_links;
      if (mass == 0) facts.without_mass.push_back(name_in(robot, world, link.object));
    }
    if (link.joint == JointKind::fixed || link.mimic >= 0) continue;
    const std::string joint = name_in(robot, world, link.joint_object);
    const bool is_placed = std::any_of(robots.joints.begin(), robots.joints.end(),
                                       [&](const auto& given) { return given.first.text == joint; });
    facts.joints.push_back(joint);
    if (!is_placed && !(link.limits.lower <= 1e-6 && link.limits.upper >= -1e-6)) facts.clamped.push_back(joint);
    if (!std::isfinite(link.limits.effort) && is_driven(world, link.joint_object))
      facts.of_any_strength.push_back(joint);
  }
  return facts;
}

}  // namespace muro::host
