// SPDX-License-Identifier: MIT
// A model of this folder that stands on flat ground, for tests.
#pragma once

#include <algorithm>
#include <cmath>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::models {

inline const std::string folder = MURO_TEST_SOURCE_DIR "/examples/models/";

/// Builds a scenario of a model with these keys of a robot, `{...}` without the braces.
inline host::BuiltScenario built(const std::string& model, const std::string& keys) {
  const test::ScratchFolder scratch;
  const std::string text = "world: {objects: {ground: {shape: plane}}}\nrobots: {r: {model: " + folder + model +
                           (keys.empty() ? "" : ", ") + keys + "}}\n";
  return host::build(host::read_scenario(scratch.file("s.yaml", text), {}), test::plugins());
}

inline const RobotView& robot_of(const host::BuiltScenario& b) { return *b.simulation->world().find_robot("r"); }

inline const Link& link_of(const host::BuiltScenario& b, const std::string& body) {
  const ObjectId object = b.simulation->world().object("r/" + body);
  const RobotView& robot = robot_of(b);
  return *std::find_if(robot.links.begin(), robot.links.end(), [&](const Link& l) { return l.object == object; });
}

inline Inertia inertia_of(const host::BuiltScenario& b, const std::string& body) {
  return b.simulation->world().constant(b.simulation->world().object("r/" + body), keys::inertial, Inertia{});
}

inline double mass_of(const host::BuiltScenario& b) {
  double mass = 0;
  for (const Link& link : robot_of(b).links)
    mass += b.simulation->world().constant(link.object, keys::inertial, Inertia{}).mass;
  return mass;
}

/// Returns whether the base has kept its height within `tolerance` (m) and tilts by less than 0.1 rad after `seconds`.
inline bool stands(host::BuiltScenario& b, double seconds, double tolerance = 0.02) {
  const auto base = [&]() -> const Pose& { return b.simulation->world().value(robot_of(b).base(), keys::pose); };
  const double height = base().position.z();
  b.simulation->run_for(seconds);
  const double upright = (base().orientation * Vec3::UnitZ()).z();
  return std::abs(base().position.z() - height) < tolerance && upright > std::cos(0.1);
}

/// Returns whether moments of inertia are those of a body: positive, and none above the sum of the others.
inline bool is_possible(const Inertia& i) {
  const double sum = i.ixx + i.iyy + i.izz, largest = std::max({i.ixx, i.iyy, i.izz});
  return std::min({i.ixx, i.iyy, i.izz}) > 0 && 2 * largest <= sum;
}

}  // namespace muro::models
