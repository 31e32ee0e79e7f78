// SPDX-License-Identifier: MIT
// Shapes that touch, as one collision algorithm sees them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/conformance/team.hpp"
#include "tests/support/collision_scene.hpp"

namespace muro::test {

/// How exact an algorithm is, and what it cannot do; as in the README of its plugin.
struct Accuracy {
  double depth = 1e-9;   ///< m: most error where there is a closed form
  double normal = 1e-9;  ///< rad
  double point = 1e-8;   ///< m
  /// Most difference of the least depth of a random pair from collision.native's, of the size of the pair: where they
  /// overlap by a hundredth of that at most, and where they overlap deeply.
  double shallow = 1e-9, deep = 1e-9;
};

inline Accuracy accuracy_of(const std::string& algorithm) {
  static const std::map<std::string, Accuracy> accuracies{
      {"collision.fcl", {.shallow = 1e-9, .deep = 0.02}},
      {"collision.ode", {.shallow = 1e-9, .deep = 0.02}},
      {"collision.bullet", {.shallow = 1e-4, .deep = 0.02}},
  };
  const auto known = accuracies.find(algorithm);
  return known == accuracies.end() ? Accuracy{} : known->second;
}

/// All collision algorithms that promise these capabilities.
inline std::vector<std::string> collisions_that_promise(std::uint32_t capabilities) {
  std::vector<std::string> ids = algorithms_of("collision");
  std::erase_if(ids, [&](const std::string& id) {
    return (plugins().algorithm(id).description->capabilities & capabilities) != capabilities;
  });
  return ids;
}

/// The contacts of a robot of one shape with a piece of scenery of another.
inline std::vector<Contact> contacts_of(const std::string& algorithm, const Shape& shape, const Pose& at,
                                        const Shape& scenery, const Pose& place) {
  CollisionScene scene(algorithm);
  scene.add_scenery("scenery", scenery, place);
  const RobotView& r = scene.add_dynamic("robot", shape, at);
  scene.finish_setup();
  scene.step_once();
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

}  // namespace muro::test
