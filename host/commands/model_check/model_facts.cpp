// SPDX-License-Identifier: MIT
#include "host/commands/model_check/model_facts.hpp"

#include <algorithm>
#include <cmath>

#include "muro/toolkit/joint_drives.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Returns "joint" for "robot/joint".
std::string name_in(const RobotView& robot, const World& world, ObjectId object) {
  const std::string& name = world.object_name(object);
  return name.size() > robot.name.size() + 1 ? name.substr(robot.name.size() + 1) : name;
}

/// Whether an algorithm writes a velocity or position target of the joint.
bool is_driven(const World& world, ObjectId joint) {
  return world.is_written(joint, keys::joint_velocity_target.name) ||
         world.is_written(joint, keys::joint_position_target.name);
}

bool is_commanded(const World& world, ObjectId joint) {
  return is_driven(world, joint) || world.is_written(joint, keys::joint_acceleration_target.name) ||
         world.is_written(joint, keys::joint_effort_target.name);
}

}  // namespace

bool is_open(const Description& motion, const std::map<std::string, ParameterInput>& parameters,
             const std::string& joint) {
  const auto is_auto = [](const Parameter& p) { return p.name == "joints" && p.default_text == "auto"; };
  const auto given = parameters.find("joints");
  const auto* word = given == parameters.end() ? nullptr : std::get_if<std::string>(&given->second);
  if ((word && *word != "auto") || std::none_of(motion.parameters.begin(), motion.parameters.end(), is_auto))
    return false;
  for (const Parameter* list : {&velocity_joints, &position_joints, &effort_joints, &passive_joints}) {
    const auto named = parameters.find(std::string(list->name));
    const auto* patterns = named == parameters.end() ? nullptr : std::get_if<std::vector<std::string>>(&named->second);
    if (!patterns) continue;
    for (const std::string& pattern : *patterns)
      if (detail::names_joint(pattern, joint)) return false;
  }
  return true;
}

UncommandedJoints uncommanded_joints(const World& world, const RobotView& robot, const Description& motion,
                                     const std::map<std::string, ParameterInput>& parameters) {
  UncommandedJoints found;
  found.are_all = true;
  for (const Link& link : robot.links) {
    if (link.joint == JointKind::fixed || link.mimic >= 0) continue;
    if (is_commanded(world, link.joint_object)) {
      found.are_all = false;
      continue;
    }
    const std::string joint = name_in(robot, world, link.joint_object);
    if (!is_open(motion, parameters, joint)) continue;
    found.all.push_back(joint);
    if (std::isfinite(link.limits.lower) || std::isfinite(link.limits.upper)) found.with_stops.push_back(joint);
  }
  return found;
}

ModelFacts model_facts(const World& world, const RobotView& robot, const RobotTemplate& robots) {
  ModelFacts facts;
  facts.links = robot.links.size();
  std::vector<bool> moves(robot.links.size());
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    const double mass = world.constant(link.object, keys::inertial, Inertia{}).mass;
    facts.mass += mass;
    facts.has_collision_shapes =
        facts.has_collision_shapes || !world.constants(link.object, keys::collision_shapes).empty();
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
