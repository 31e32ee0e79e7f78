// SPDX-License-Identifier: MIT
// Robots with the control code of test_controllers/, for the tests of controller.library.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"
#include "tests/support/scene.hpp"

namespace muro::control {

using Texts = std::vector<std::string>;
using Settings = std::map<std::string, ParameterInput>;

inline const std::string folder = CONTROLLERS "/";

inline RobotTree two_arms() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
    b.fork();
    b.revolute("left", Vec3::UnitZ(), {});
    b.body("left_arm");
    b.end();
    b.revolute("right", Vec3::UnitZ(), {});
    b.body("right_arm");
    b.end();
  });
}

/// Two robots "a" and "b" that move as commanded, at 20 Hz.
struct Team : test::Scene {
  explicit Team(std::uint64_t seed = 1) : Scene(seed) {
    const RobotTree tree = two_arms();
    a = &add("a", tree);
    b = &add("b", tree, {{4, 0, 0}, Quat::Identity()});
    use("motion.point", 20, all_robots());
  }
  void control(const std::string& library, Settings settings = {}) {
    control_by(library, all_robots(), std::move(settings));
  }
  void control_by(const std::string& library, std::vector<Item> items, Settings settings = {}) {
    settings["library"] = library;
    use("controller.library", 10, std::move(items), std::move(settings));
  }
  Twist& command(const RobotView& r) { return world().value(r.base(), keys::command_twist); }

  const RobotView* a = nullptr;
  const RobotView* b = nullptr;
};

/// Returns the error message of a failed build.
template <class S>
std::string refusal(S& s) {
  return test::complaint_of([&] { s.build(); });
}

inline std::string refusal_of(const std::string& library, Settings settings = {}) {
  Team team;
  team.control(folder + library, std::move(settings));
  return refusal(team);
}

inline ::testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << text << "\nlacks\n" << part;
}

}  // namespace muro::control
