// SPDX-License-Identifier: MIT
#pragma once

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

/// Of a robot of `robots`. [after set-up]
ModelFacts model_facts(const World& world, const RobotView& robot, const RobotTemplate& robots);

}  // namespace muro::host
