// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/world.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// What the model of a robot has, and which of its parts lack something, each by its name in the model.
struct ModelFacts {
  using Names = std::vector<std::string>;

  std::size_t links = 0;
  Names joints;     ///< that can move and mimic none
  double mass = 0;  ///< kg
  bool has_collision_shapes = false;

  std::size_t moving_links = 0;  ///< behind a joint that can move
  Names without_mass;            ///< of them
  bool moves_mass() const { return without_mass.size() < moving_links; }

  Names clamped;          ///< joints that cannot be at 0, and the scenario does not say where they start
  Names of_any_strength;  ///< joints without a limit of effort that follow a target which something writes
};

/// Joints that no algorithm commands.
struct UncommandedJoints {
  ModelFacts::Names all, with_stops;  ///< each by its name in the model
  bool are_all = false;               ///< no joint of the robot is commanded
};

/// Whether `parameters` of a motion leave it open what this joint follows.
bool is_open(const Description& motion, const std::map<std::string, ParameterInput>& parameters,
             const std::string& joint);
/// Of a robot whose motion has these `parameters`: of the joints that they leave open. [after set-up]
UncommandedJoints uncommanded_joints(const World& world, const RobotView& robot, const Description& motion,
                                     const std::map<std::string, ParameterInput>& parameters);

/// Of a robot of `robots`. [after set-up]
ModelFacts model_facts(const World& world, const RobotView& robot, const RobotTemplate& robots);

}  // namespace muro::host
