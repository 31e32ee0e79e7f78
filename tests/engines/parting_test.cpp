// SPDX-License-Identifier: MIT
// A body that starts in scenery moves out of it at a bounded speed.
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/engines/engine_scene.hpp"
#include "tests/support/files.hpp"

namespace muro::engines {
namespace {

using test::block;

constexpr double correcting_speed = 1;  ///< m/s: the default of all motions

/// Returns the largest speed of `robot` within `seconds`, less that of its fall.
double top_speed(World& w, const RobotView& robot, double seconds) {
  const double start = w.pose(robot).position.z();
  double fastest = 0;
  for (int i = 0; i < int(seconds * 1000); ++i) {
    w.run_for(0.001);
    const double fall = std::max(0.0, start - w.pose(robot).position.z());
    fastest = std::max(fastest, w.twist(robot).linear.norm() - std::sqrt(2 * 9.81 * fall));
  }
  return fastest;
}

class WhatOverlaps : public ::testing::TestWithParam<std::string> {
 protected:
  World w;
};

TEST_P(WhatOverlaps, RisesOutOfTheGroundSlowly) {
  w.add_ground(0.5);
  const RobotView& r = w.add("box", block(10, {0.4, 0.4, 0.4}, 0.5), {{0, 0, -0.1}, Quat::Identity()});
  w.start(GetParam());
  EXPECT_LT(top_speed(w, r, 2), 1.1 * correcting_speed);
  EXPECT_NEAR(w.pose(r).position.z(), 0.2, 2e-3) << "it stands on the ground";
}

TEST_P(WhatOverlaps, LeavesAWallSlowly) {
  w.add_ground(0.5);
  w.add_box("wall", {0.4, 0, 1}, {0.4, 4, 2});
  const RobotView& r = w.add("box", block(10, {0.4, 0.4, 0.4}, 0.5), {{0.15, 0, 0.2}, Quat::Identity()});
  w.start(GetParam());
  EXPECT_LT(top_speed(w, r, 2), 1.5 * correcting_speed);
  EXPECT_LT(w.pose(r).position.x(), 0.01) << "it is out of the wall";
}

TEST_P(WhatOverlaps, OfARoverIsPartedSlowly) {
  w.add_ground(0.5);
  w.add_box("wall", {0.4, 0, 1}, {0.4, 4, 2}, 0.5);
  const RobotTree model = w.read_model(MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf");
  const RobotView& r = w.add("rover", model, {{0.35, 0, 0.15}, from_rpy(0, 0, 0.3)});
  w.start(GetParam());
  EXPECT_LT(top_speed(w, r, 2), 5 * correcting_speed) << "its wheels leave the wall on different ways";
}

INSTANTIATE_TEST_SUITE_P(Engines, WhatOverlaps, ::testing::ValuesIn(all_motions()), name_of);

class AMeshThatOverlaps : public ::testing::TestWithParam<std::string> {};

TEST_P(AMeshThatOverlaps, IsPartedSlowly) {
  const test::ScratchFolder folder;
  World w;
  Shape shape{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
  const std::string file =
      folder.file("box.stl", mesh::testing::stl_text(mesh::testing::box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2})));
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, test::solid_box(5, {0.4, 0.4, 0.4}));
    shape.mesh = b.intern(file);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  });
  w.add_ground(0.5);
  const RobotView& r = w.add("mesh", tree, {{0, 0, -0.1}, Quat::Identity()});
  w.start(GetParam());
  EXPECT_LT(top_speed(w, r, 2), 1.1 * correcting_speed);
  EXPECT_NEAR(w.pose(r).position.z(), 0.2, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Engines, AMeshThatOverlaps, ::testing::ValuesIn(engine_motions()), name_of);

}  // namespace
}  // namespace muro::engines
