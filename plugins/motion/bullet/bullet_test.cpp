// SPDX-License-Identifier: MIT
// Tests of motion.bullet only. Tests for all motions are in tests/conformance.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;

constexpr double g = 9.81;
using test::solid_box;

struct Drop : test::Scene {
  void start(Parameters parameters = {}) {
    use("motion.bullet", 1000, all_robots(), std::move(parameters));
    build();
  }
  Shape mesh(const std::string& file) {
    Shape s{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
    s.mesh = world().intern(file);
    return s;
  }
};

const Inertia roller{.mass = 1, .ixx = 0.01, .iyy = 0.01, .izz = 0.005};  // radius 0.1 m, length 0.3 m

TEST(ACylinderOnABox, RollsAsOnAPlane) {
  Drop t;
  const double angle = 20 * M_PI / 180;
  const Quat tilt = from_rpy(0, -angle, 0);
  Shape slope = Shape::box({40, 10, 2});
  slope.origin.position.z() = -1;
  t.world().add_scenery("slope", {Vec3::Zero(), tilt}, std::span<const Shape>(&slope, 1));
  const RobotView& r = t.add("r", test::single_body(Shape::cylinder(0.1, 0.3), roller),
                             {tilt * Vec3(0, 0, 0.1), tilt * from_rpy(M_PI / 2, 0, 0)});
  t.start();
  const auto speed = [&] { return -t.twist(r).linear.dot(tilt * Vec3::UnitX()); };
  t.run_for(0.5);
  const double before = speed();
  t.run_for(1);
  EXPECT_NEAR((speed() - before) / (2.0 / 3 * g * std::sin(angle)), 1, 1e-3);
  EXPECT_NEAR(t.pose(r).position.y(), 0, 1e-4);
}

TEST(ACylinderOnABox, StandsUprightAndLiesOverAnEdge) {
  Drop t;
  const Shape table = Shape::box({1, 1, 1});
  t.world().add_scenery("table", {{0, 0, 0.5}, Quat::Identity()}, std::span<const Shape>(&table, 1));
  const RobotTree cylinder = test::single_body(Shape::cylinder(0.1, 0.3), roller);
  const RobotView& upright = t.add("upright", cylinder, {{0, 0, 1.16}, from_rpy(0.05, 0.02, 0)});
  const RobotView& over = t.add("over", cylinder, {{0.3, 0.45, 1.1}, from_rpy(M_PI / 2, 0, 0)});
  t.start();
  t.run_for(3);
  const Pose before = t.pose(over);
  EXPECT_NEAR(t.pose(upright).position.z(), 1.15, 2e-4);
  t.run_for(3);
  EXPECT_NEAR(t.pose(over).position.z(), 1.1, 1e-3);
  EXPECT_LT((t.pose(over).position - before.position).norm(), 1e-3);
}

TEST(AStackOfTenBoxes, StandsUnderTwiceItsWeight) {
  Drop t;
  t.add_ground();
  std::vector<const RobotView*> boxes;
  for (int i = 0; i < 10; ++i)
    boxes.push_back(&t.add("box_" + std::to_string(i),
                           test::single_body(Shape::box({0.2, 0.2, 0.2}), solid_box(i < 9 ? 1 : 20, {0.2, 0.2, 0.2})),
                           {{0, 0, 0.1 + 0.2 * i}, Quat::Identity()}));
  t.start({{"iterations", std::int64_t(50)}});
  t.run_for(5);
  EXPECT_NEAR(t.pose(*boxes[9]).position.z(), 1.9, 5e-3);
  EXPECT_LT(t.pose(*boxes[9]).position.head<2>().norm(), 0.01);
}

/// A disc (1 kg, radius 0.1 m) on an axle of 0.1 m that is held at its end, released level with the spin `spin`.
TEST(ATop, NodsWithoutGainingEnergy) {
  for (const double spin : {20.0, 100.0, 200.0}) {
    Drop t;
    const Inertia light{.mass = 1e-4, .ixx = 1e-7, .iyy = 1e-7, .izz = 1e-7};
    const Inertia disc{.mass = 1, .com = {0.1, 0, 0}, .ixx = 0.005, .iyy = 0.0025, .izz = 0.0025};
    t.add("r", test::tree_of([&](RobotBuilder& b) {
            b.base("base");
            b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
            b.revolute("turn", Vec3::UnitZ(), {});
            b.body("fork");
            b.set(keys::inertial, light);
            b.revolute("nod", Vec3::UnitY(), {});
            b.body("axle");
            b.set(keys::inertial, light);
            b.revolute("spin", Vec3::UnitX(), {});
            b.body("disc");
            b.set(keys::inertial, disc);
          }));
    t.start({{"base", std::string("fixed")}, {"joints", std::string("passive")}});
    const auto value = [&](const char* joint, const Key<double>& key) -> double& {
      return t.world().value(std::string("r/") + joint, key);
    };
    value("spin", keys::joint_velocity) = spin;
    const auto energy = [&] {
      const double nod = value("nod", keys::joint_position), turn = value("turn", keys::joint_velocity),
                   nodding = value("nod", keys::joint_velocity),
                   own = value("spin", keys::joint_velocity) - turn * std::sin(nod), across = std::cos(nod) * turn;
      return 0.0025 * own * own + 0.00625 * (nodding * nodding + across * across) - 0.1 * g * std::sin(nod);
    };
    const double before = energy();
    for (int k = 0; k < 50; ++k) {
      t.run_for(0.1);
      EXPECT_NEAR(energy() - before, 0, 0.05) << "J, at " << spin << " rad/s after " << k << " tenths of a second";
    }
  }
}

TEST(APileOfAllShapes, GoesOnFromASnapshotToTheSameBits) {
  Drop t;
  t.add_ground();
  const Shape shapes[] = {Shape::box({0.2, 0.3, 0.2}), Shape::cylinder(0.1, 0.2), Shape::capsule(0.08, 0.2),
                          Shape::sphere(0.12)};
  for (int i = 0; i < 12; ++i)
    t.add("r" + std::to_string(i), test::single_body(shapes[i % 4], {.mass = 1, .ixx = 0.01, .iyy = 0.01, .izz = 0.01}),
          {{0.05 * (i % 3), 0.04 * (i % 5), 0.3 + 0.3 * i}, from_rpy(0.3 * i, 0.2 * i, 0)});
  t.start();
  t.run_for(1.2);
  const Snapshot middle = t.snapshot();
  t.run_for(1);
  const std::uint64_t end = t.state_hash();
  t.restore(middle);
  t.run_for(1);
  EXPECT_EQ(t.state_hash(), end);
}

TEST(AMesh, OfABoxLiesAsABox) {
  const test::ScratchFolder folder;
  const std::string file =
      folder.file("box.stl", mesh::testing::stl_text(mesh::testing::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})));
  Drop t;
  t.add_ground();
  const Shape table = Shape::box({1, 1, 1});
  t.world().add_scenery("table", {{5, 0, 0.5}, Quat::Identity()}, std::span<const Shape>(&table, 1));
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    Shape s{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
    s.mesh = b.intern(file);
    b.base("body");
    b.set(keys::inertial, solid_box(1, {0.2, 0.2, 0.2}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&s, 1));
  });
  const RobotView& low = t.add("low", tree, {{0, 0, 0.12}, Quat::Identity()});
  const RobotView& high = t.add("high", tree, {{5, 0, 1.12}, Quat::Identity()});
  t.start();
  t.run_for(3);
  EXPECT_NEAR(t.pose(low).position.z(), 0.1, 1e-3);
  EXPECT_NEAR(t.pose(high).position.z(), 1.1, 2e-3) << "on a box";
}

/// A gutter along y: two sides of 45 deg that meet at z = 0.
std::string gutter() {
  mesh::Mesh m;
  m.vertices = {{-1, -1, 1}, {-1, 1, 1}, {0, -1, 0}, {0, 1, 0}, {1, -1, 1}, {1, 1, 1}};
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
  return mesh::testing::obj_text(m);
}

TEST(AMesh, OfSceneryHoldsABallInItsHollowWhenItIsExact) {
  const test::ScratchFolder folder;
  for (const bool exact : {true, false}) {
    Drop t;
    const Shape shape = t.mesh(folder.file("gutter.obj", gutter()));
    t.world().add_scenery("gutter", {}, std::span<const Shape>(&shape, 1));
    const RobotView& r =
        t.add("r", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 0.004, .iyy = 0.004, .izz = 0.004}),
              {{0, 0, exact ? 0.2 : 1.15}, Quat::Identity()});
    t.start({{"meshes", std::string(exact ? "exact" : "convex")}});
    t.run_for(2);
    EXPECT_NEAR(t.pose(r).position.z(), exact ? 0.1 * M_SQRT2 : 1.1, 2e-3) << (exact ? "exact" : "convex");
  }
}

}  // namespace
}  // namespace muro
