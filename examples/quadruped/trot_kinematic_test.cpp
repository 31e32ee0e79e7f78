// SPDX-License-Identifier: MIT
// Legs by positions under a base that moves as commanded: standing feet stay where they are.
#include <gtest/gtest.h>

#include <array>

#include "quadruped_testing.hpp"
#include "tests/support/files.hpp"

namespace muro::quadruped_test {
namespace {

const std::array<const char*, 4> feet = {"front_left_foot", "front_right_foot", "rear_left_foot", "rear_right_foot"};

host::BuiltScenario kinematic(const test::ScratchFolder& folder, const std::string& tunables) {
  const std::string text =
      "world: {objects: {ground: {shape: plane}}}\n"
      "robots:\n"
      "  pacer:\n"
      "    model: " MURO_TEST_SOURCE_DIR
      "/examples/models/quadruped.urdf\n"
      "    motion: {use: motion.point, rate: 200, height_above_ground: 0.32}\n"
      "    kinematics: {use: kinematics.direct, rate: 200}\n"
      "    trot: {use: controller.library, library: trot_kinematic, rate: 200,\n"
      "      outputs: [\"joint.position.target=*:joint.position.target\"], tunables: [" +
      tunables + "]}\n";
  return host::build(host::read_scenario(folder.file("pacer.yaml", text), {}), test::plugins());
}

TEST(TrotKinematic, FeetThatStandDoNotSlip) {
  test::ScratchFolder folder;
  host::BuiltScenario built = kinematic(folder, "forward=0.4, left=0.1, turn=0.5");
  Simulation& s = *built.simulation;
  const auto foot = [&](std::size_t i) {
    return s.world().value(std::string("pacer/") + feet[i], keys::pose).position;
  };
  s.run_for(1);
  double slip = 0, lifted = 0, sunk = 0;
  int standing = 0, steps = 0;
  for (int k = 0; k < 200; ++k, ++steps) {
    std::array<Vec3, 4> before;
    for (std::size_t i = 0; i < 4; ++i) before[i] = foot(i);
    s.run_for(0.005);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 now = foot(i);
      lifted = std::max(lifted, now.z()), sunk = std::max(sunk, 0.02 - now.z());
      const bool stands = before[i].z() < 0.0201 && now.z() < 0.0201;
      if (!stands) continue;
      ++standing;
      slip = std::max(slip, (now - before[i]).norm());
    }
  }
  EXPECT_LT(slip, 1e-4) << "m in 5 ms, in which the base goes 2 mm";
  EXPECT_LT(sunk, 1e-6) << "below the ground";
  EXPECT_NEAR(lifted, 0.02 + 0.06, 0.003) << "m: radius and lift";
  EXPECT_NEAR(double(standing) / steps, 2, 0.1) << "feet, of four";
}

TEST(TrotKinematic, StandsStillWithoutACommand) {
  test::ScratchFolder folder;
  host::BuiltScenario built = kinematic(folder, "");
  Simulation& s = *built.simulation;
  s.run_for(0.5);
  const Vec3 before = s.world().value("pacer/rear_left_foot", keys::pose).position;
  s.run_for(0.5);
  EXPECT_LT((s.world().value("pacer/rear_left_foot", keys::pose).position - before).norm(), 1e-12);
  EXPECT_NEAR(before.z(), 0.02, 1e-9) << "on the ground";
}

}  // namespace
}  // namespace muro::quadruped_test
