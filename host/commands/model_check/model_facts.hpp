// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/world.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Parts of the model of a robot, and those of them that lack something, each by its name in the model.
struct ModelFacts {
  using Names = std::vector<std::string>;

  std::size_t links = 0;
  Names joints;     ///< joints that can move and mimic none
  double mass = 0;  ///< kg
  bool has_collision_shapes = false;

  std::size_t moving_links = 0;  ///< links behind a joint that can move
  Names without_mass;            ///< those of them that have no mass
  bool moves_mass() const { return without_mass.size() < moving_links; }

  Names clamped;          ///< joints that cannot be at 0, and for which the scenario gives no start
  Names of_any_strength;  ///< joints without a limit of effort that follow a target which an algorithm writes
};

/// Joints that no algorithm commands.
struct UncommandedJoints {
  ModelFacts::Names all, with_stops;  ///< each by its name in the model
  bool are_all = false;               ///< no joint of the robot is commanded
};

/// Whether `parameters` of a motion leave open what this joint follows.
bool is_open(const Description& motion, const std::map<std::string, ParameterInput>& parameters,
             const std::string& joint);
/// Finds uncommanded joints among those that the `parameters` of the robot's motion leave open. [after set-up]
UncommandedJoints uncommanded_joints(const World& world, const RobotView& robot, const Description& motion,
                                     const std::map<std::string, ParameterInput>& parameters);

/// Returns the facts about the model of a robot of `robots`. [after set-up]
ModelFacts model_facts(const World& world, const RobotView& robot, const RobotTemplate& robots);

}  // namespace muro::host
