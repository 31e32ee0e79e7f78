// SPDX-License-Identifier: MIT
// Shapes that touch, as one collision algorithm sees them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/conformance/team.hpp"

namespace muro::test {

/// How exact an algorithm is, and what it cannot do; as in the README of its plugin.
struct Ability {
  double depth = 1e-9;   ///< m: most error where there is a closed form
  double normal = 1e-9;  ///< rad
  double point = 1e-8;   ///< m
  /// Most difference of the least depth of a random pair from collision.native's, of the size of the pair: where they
  /// overlap by a hundredth of that at most, and where they overlap deeply.
  double shallow = 1e-9, deep = 1e-9;
  bool meshes = true;
};

inline Ability ability_of(const std::string& algorithm) {
  static const std::map<std::string, Ability> abilities{
      {"collision.native", {.meshes = false}},
      {"collision.fcl", {.shallow = 1e-9, .deep = 0.02}},
      {"collision.ode", {.shallow = 1e-9, .deep = 0.02}},
      {"collision.bullet", {.shallow = 1e-4, .deep = 0.02}},
  };
  const auto known = abilities.find(algorithm);
  return known == abilities.end() ? Ability{} : known->second;
}

inline const Inertia unit_inertia = Inertia::from(1, Vec3::Zero(), 0.1 * Mat3::Identity());

/// Robots that forces move (motion.simplified) or commands (motion.point) without gravity, and the contacts of the
/// poses they start in.
struct Touching : Scene {
  std::string algorithm;
  std::map<std::string, ParameterInput> parameters;

  explicit Touching(std::string collision) : algorithm(std::move(collision)) {
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  }
  const RobotView& add_dynamic(const std::string& name, const RobotTree& tree, const Pose& start) {
    const RobotView& r = add(name, tree, start);
    use("motion.simplified", 100, {{&r, r.base()}});
    return r;
  }
  const RobotView& add_dynamic(const std::string& name, const Shape& shape, const Pose& start) {
    return add_dynamic(name, single_body(shape, unit_inertia), start);
  }
  const RobotView& add_kinematic(const std::string& name, const Shape& shape, const Pose& start) {
    const RobotView& r = add(name, single_body(shape, unit_inertia), start);
    use("motion.point", 100, {{&r, r.base()}});
    return r;
  }
  ObjectId add_scenery(const std::string& name, const Shape& shape, const Pose& pose) {
    world().add_scenery(name, pose, std::span<const Shape>(&shape, 1));
    return world().object(name);
  }
  void finish_setup() {
    use_kinematics();
    use("scene.bvh", 0);
    use(algorithm, 100, {}, parameters);
    build();
  }
  /// Afterwards contacts are those of the poses before it.
  void instant() { run_for(0.01); }
  std::vector<Contact> contacts(const RobotView& r) {
    const std::span<Contact> list = world().values(r.base(), keys::contacts);
    return {list.begin(), list.end()};
  }
};

/// The contacts of a robot of one shape with a piece of scenery of another.
inline std::vector<Contact> contacts_of(const std::string& algorithm, const Shape& shape, const Pose& at,
                                        const Shape& scenery, const Pose& place) {
  Touching scene(algorithm);
  scene.add_scenery("scenery", scenery, place);
  const RobotView& r = scene.add_dynamic("robot", shape, at);
  scene.finish_setup();
  scene.instant();
  return scene.contacts(r);
}

inline const Contact& deepest(const std::vector<Contact>& contacts) {
  return *std::max_element(contacts.begin(), contacts.end(),
                           [](const Contact& a, const Contact& b) { return a.depth < b.depth; });
}

/// For messages.
inline std::string text_of(const std::vector<Contact>& contacts) {
  std::ostringstream out;
  out.precision(10);
  for (const Contact& c : contacts)
    out << "\n  at " << c.point.transpose() << ", depth " << c.depth << " along " << c.normal.transpose();
  return out.str();
}

inline std::string name_of(const ::testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace muro::test
