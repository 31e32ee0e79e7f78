// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/algorithm_setup.hpp"
#include "core/world.hpp"
#include "muro/features.hpp"

namespace muro::host {

/// A feature of its motion that a robot uses.
struct UsedFeature {
  Features bit;        ///< one of Feature
  std::string amount;  ///< "4 joints", or empty
};

/// Properties of the scenery that concern all robots.
struct SceneryTraits {
  std::size_t meshes = 0, heightmaps = 0;
  Surface surface{0, 0, 0, 0};  ///< the largest value of each
};
SceneryTraits scenery_traits(const World& world);

/// The way in which a motion serves a robot.
struct MotionUse {
  const std::map<std::string, ParameterInput>& parameters;
  bool own_contacts = false;  ///< the motion finds contacts and their forces itself: a world
  bool contacts = true;       ///< any algorithm finds contacts and their forces
};

/// Returns the features that a robot uses of its motion, in the order of Feature. They follow from its model (mass,
/// shapes, joints with their finite limits, damping and friction), from the parameters of the motion, and from the
/// algorithms that write targets of its joints. [after set-up]
std::vector<UsedFeature> used_features(const World& world, const SceneryTraits& scenery, const RobotView& robot,
                                       const MotionUse& use);

}  // namespace muro::host
