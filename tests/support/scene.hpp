// SPDX-License-Identifier: MIT
// A small simulation for a test: real core, real plugins from the build.
#pragma once

#include <functional>

#include "core/simulation.hpp"
#include "muro/vocabulary.hpp"

namespace muro::test {

inline Registry& plugins() {
  static Registry registry({MURO_TEST_PLUGIN_DIR});
  return registry;
}

/// A tree built by `build`, checked to be usable.
inline RobotTree tree_of(const std::function<void(RobotBuilder&)>& build) {
  RobotTree tree;
  build(tree);
  tree.close();
  std::vector<std::string> problems;
  for (const auto& p : tree.problems()) problems.push_back(p.text);
  if (!tree.usable()) throw SetupError(problems);
  return tree;
}

/// A robot of one body with one shape.
inline RobotTree single_body(const Shape& shape, const Inertia& inertia) {
  return tree_of([&](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  });
}

struct Scene : Simulation {
  explicit Scene(std::uint64_t seed = 1) : Simulation(plugins(), seed) {}

  const RobotView& add(std::string_view name, const RobotTree& tree, const Pose& start = {}, const Twist& twist = {}) {
    const RobotView& robot = world().add_robot(name, tree, start);
    world().set(robot.base(), keys::initial_twist, twist);
    return robot;
  }
  void add_ground(double friction = 0.8, const Pose& pose = {}) {
    Shape plane = Shape::plane();
    plane.friction = friction;
    world().add_scenery("ground", pose, std::span<const Shape>(&plane, 1));
  }
  /// Index, collision, contact and kinematics, all on demand, for the robots added so far.
  void use_contacts(std::map<std::string, ParameterInput> contact_parameters = {}) {
    use_kinematics();
    use("scene.bvh", 0);
    use("collision.native", 0);
    use("contact.penalty", 0, {}, std::move(contact_parameters));
  }
  void use_kinematics() { use("kinematics.direct", 0, all_robots()); }
  std::vector<Item> all_robots() {
    std::vector<Item> items;
    for (const RobotView* r : world().robots()) items.push_back({r, r->base()});
    return items;
  }
  Pose& pose(const RobotView& robot) { return world().value(robot.base(), keys::pose); }
  Twist& twist(const RobotView& robot) { return world().value(robot.base(), keys::twist); }
};

}  // namespace muro::test
