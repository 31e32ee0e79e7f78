// SPDX-License-Identifier: MIT
#include "tests/support/scene.hpp"

namespace muro::test {

Registry& plugins() {
  static Registry registry({MURO_TEST_PLUGIN_DIR});
  return registry;
}

RobotTree tree_of(const std::function<void(RobotBuilder&)>& build) {
  RobotTree tree;
  build(tree);
  tree.close();
  std::vector<std::string> problems;
  for (const auto& p : tree.problems()) problems.push_back(p.text);
  if (!tree.usable()) throw SetupError(problems);
  return tree;
}

Scene::Scene(std::uint64_t seed) : Simulation(plugins(), seed) {}
Scene::~Scene() = default;

const RobotView& Scene::add(std::string_view name, const RobotTree& tree, const Pose& start, const Twist& twist) {
  const RobotView& robot = world().add_robot(name, tree, start);
  world().set(robot.base(), keys::initial_twist, twist);
  return robot;
}

void Scene::add_ground(double friction, const Pose& pose) {
  Shape plane = Shape::plane();
  plane.surface.friction = friction;
  world().add_scenery("ground", pose, std::span<const Shape>(&plane, 1));
}

void Scene::use_contacts(std::map<std::string, ParameterInput> contact_parameters,
                         std::map<std::string, ParameterInput> collision_parameters) {
  use_kinematics();
  use("scene.bvh", 0);
  use("collision.native", 0, {}, std::move(collision_parameters));
  use("contact.penalty", 0, {}, std::move(contact_parameters));
}

void Scene::use_kinematics() { use("kinematics.direct", 0, all_robots()); }

std::vector<Item> Scene::all_robots() {
  std::vector<Item> items;
  for (const RobotView* r : world().robots()) items.push_back({r, r->base()});
  return items;
}

Wrench& Scene::push(const RobotView& robot) {
  PropertyStore& store = world().store();
  return *static_cast<Wrench*>(store.bind(store.add_accessor("the test"), robot.base(), keys::external_wrench,
                                          usage::accumulate, Multiplicity::single, 1, nullptr));
}

Pose& Scene::pose(const RobotView& robot) { return world().value(robot.base(), keys::pose); }
Twist& Scene::twist(const RobotView& robot) { return world().value(robot.base(), keys::twist); }

}  // namespace muro::test
