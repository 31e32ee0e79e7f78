// SPDX-License-Identifier: MIT
// A small simulation for a test: real core, real plugins from the build.
#pragma once

#include <functional>

#include "core/simulation.hpp"
#include "muro/vocabulary.hpp"

namespace muro::test {

/// Returns the plugins of the build.
Registry& plugins();

/// Returns a tree built by `build`, checked to be usable.
RobotTree tree_of(const std::function<void(RobotBuilder&)>& build);

struct Scene : Simulation {
  explicit Scene(std::uint64_t seed = 1);
  ~Scene();

  const RobotView& add(std::string_view name, const RobotTree& tree, const Pose& start = {}, const Twist& twist = {});
  void add_ground(double friction = 0.8, const Pose& pose = {});
  /// Adds index, collision, contact and kinematics, all on demand, for the robots added so far.
  void use_contacts(std::map<std::string, ParameterInput> contact_parameters = {},
                    std::map<std::string, ParameterInput> collision_parameters = {});
  void use_kinematics();
  std::vector<Item> all_robots();

  /// Returns a wrench at a robot's base that the test sets, a summand of the external wrench. Call it before build().
  Wrench& push(const RobotView& robot);

  Pose& pose(const RobotView& robot);
  Twist& twist(const RobotView& robot);
};

}  // namespace muro::test
