// SPDX-License-Identifier: MIT
// Contacts of two shapes, as one collision algorithm finds them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/conformance/team.hpp"
#include "tests/support/collision_scene.hpp"

namespace muro::test {

/// Accuracy of an algorithm, as in the README of its plugin.
struct Accuracy {
  double depth = 1e-9;   ///< m: largest error where there is a closed form
  double normal = 1e-9;  ///< rad
  double point = 1e-8;   ///< m
  /// Largest difference of the depth of a random pair from that of collision.native, as a fraction of the size of the
  /// pair: `shallow` for overlaps of up to a hundredth of the size, `deep` for deep overlaps.
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

/// Returns all collision algorithms that promise these capabilities.
inline std::vector<std::string> collisions_that_promise(std::uint32_t capabilities) {
  std::vector<std::string> ids = algorithms_of("collision");
  std::erase_if(ids, [&](const std::string& id) {
    return (plugins().algorithm(id).description->capabilities & capabilities) != capabilities;
  });
  return ids;
}

/// Returns the contacts of a robot of one shape with a piece of scenery of another.
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

/// Returns the contacts as text for messages.
inline std::string text_of(const std::vector<Contact>& contacts) {
  std::ostringstream out;
  out.precision(10);
  for (const Contact& c : contacts)
    out << "\n  at " << c.point.transpose() << ", depth " << c.depth << " along " << c.normal.transpose();
  return out.str();
}

}  // namespace muro::test
