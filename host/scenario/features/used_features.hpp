// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/algorithm_setup.hpp"
#include "core/world.hpp"
#include "muro/features.hpp"

namespace muro::host {

/// A feature that a robot uses of the motion that moves it.
struct UsedFeature {
  Features bit;        ///< one of Feature
  std::string amount;  ///< "4 joints", or empty
};

/// What all robots meet.
struct SceneryTraits {
  std::size_t meshes = 0, heightmaps = 0;
  Surface surface{0, 0, 0, 0};  ///< the largest of each
};
SceneryTraits scenery_traits(const World& world);

/// How a motion serves a robot.
struct MotionUse {
  const std::map<std::string, ParameterInput>& parameters;
  bool own_contacts = false;  ///< the motion itself finds contacts and their forces: a world
  bool contacts = true;       ///< some algorithm finds contacts and their forces
};

/// The features that a robot uses of its motion, in the order of Feature. They follow from its model (mass, shapes,
/// joints with their finite limits, damping and friction), from the parameters of the motion, and from the algorithms
/// that write targets of its joints. [after set-up]
std::vector<UsedFeature> used_features(const World& world, const SceneryTraits& scenery, const RobotView& robot,
                                       const MotionUse& use);

}  // namespace muro::host
