// SPDX-License-Identifier: MIT
// A state from which an engine cannot continue is an error with the robot and advice, and does not end the process.
#include <cmath>
#include <limits>

#include "plugins/common/mesh/files_testing.hpp"
#include "tests/engines/engine_scene.hpp"
#include "tests/support/files.hpp"

namespace muro::engines {
namespace {

using test::ball;
using test::block;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

class AnEngine : public ::testing::TestWithParam<std::string> {
 protected:
  AnEngine() {
    w.add_ground();
    first = &w.add("first", block(1, {0.2, 0.2, 0.2}, 0.5), {{0, 0, 0.1}, Quat::Identity()});
    second = &w.add("second", block(1, {0.2, 0.2, 0.2}, 0.5), {{2, 0, 0.1}, Quat::Identity()});
  }
  World w;
  const RobotView* first = nullptr;
  const RobotView* second = nullptr;
};

TEST_P(AnEngine, NamesTheRobotWhosePoseIsNotANumber) {
  w.start(GetParam());
  w.run_for(0.01);
  w.pose(*second).position.x() = not_a_number;
  const std::string failure = w.failure_in(0.01);
  EXPECT_SAYS(failure, "`second`");
  EXPECT_SAYS(failure, "not finite");
  EXPECT_SAYS(failure, "at t = 0.01");
}

TEST_P(AnEngine, NamesTheRobotWithoutAnOrientation) {
  w.start(GetParam());
  w.pose(*second).orientation.coeffs().setZero();
  EXPECT_SAYS(w.failure_in(0.01), "`second`");
}

TEST_P(AnEngine, NamesTheLinkWhoseExternalWrenchIsNotFinite) {
  Wrench& push = w.push(*second);
  w.start(GetParam());
  push.force.x() = not_a_number;
  const std::string failure = w.failure_in(0.01);
  EXPECT_SAYS(failure, "`second");
  EXPECT_SAYS(failure, "wrench.external");
}

TEST_P(AnEngine, NamesTheRobotThatAHugeForceThrowsAway) {
  Wrench& push = w.push(*second);
  w.start(GetParam());
  push.force = Vec3(1e300, 0, 0);
  const std::string failure = w.failure_in(1);
  EXPECT_SAYS(failure, "`second`");
  EXPECT_SAYS(failure, "no longer finite");
}

TEST_P(AnEngine, RunsAgainAfterAFailure) {
  w.start(GetParam());
  w.run_for(0.5);
  const Snapshot before = w.snapshot();
  w.run_for(0.1);
  const std::uint64_t hash = w.state_hash();
  w.pose(*second).position.x() = not_a_number;
  w.failure_in(0.01);
  w.restore(before);
  w.run_for(0.1);
  EXPECT_EQ(w.state_hash(), hash);
}

INSTANTIATE_TEST_SUITE_P(Engines, AnEngine, ::testing::ValuesIn(engine_motions()), name_of);

class AnEngineAndAJoint : public ::testing::TestWithParam<std::string> {};

TEST_P(AnEngineAndAJoint, NamesTheTargetThatIsNotANumber) {
  World w;
  w.add("arm", test::tree_of([](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, test::solid_box(1, {0.2, 0.2, 0.2}));
          b.revolute("elbow", Vec3::UnitZ(), {});
          b.body("hand");
          b.set(keys::inertial, test::solid_box(1, {1, 0.1, 0.1}));
        }));
  w.start(GetParam());
  w.world().value("arm/elbow", keys::joint_velocity_target) = not_a_number;
  const std::string failure = w.failure_in(0.01);
  EXPECT_SAYS(failure, "the target of `arm/elbow` is not finite");
}

TEST_P(AnEngineAndAJoint, NamesARobotOfAnotherMotionThatIsNowhere) {
  World w;
  w.add("block", block(1, {0.2, 0.2, 0.2}, 0.5));
  const std::vector<Item> moved = w.all_robots();
  const RobotView& ghost = w.add("ghost", ball(1, 0.1, 0.5), {{1, 0, 0}, Quat::Identity()});
  w.use("motion.point", 1000, {w.all_robots().back()});
  w.use(GetParam(), 1000, moved);
  w.use_contacts();
  w.build();
  w.pose(ghost).position.y() = not_a_number;
  EXPECT_SAYS(w.failure_in(0.01), "`ghost");
}

INSTANTIATE_TEST_SUITE_P(Engines, AnEngineAndAJoint, ::testing::ValuesIn(engine_motions()), name_of);

/// Checks a box about (5, 0, 0), far from its own origin.
TEST(EnginesOfCollision, WriteNothingToTheStandardOutput) {
  const test::ScratchFolder folder;
  const std::string file =
      folder.file("far.stl", mesh::testing::stl_text(mesh::testing::box({4.9, -0.1, -0.1}, {5.1, 0.1, 0.1})));
  for (const char* engine : {"collision.ode", "collision.bullet", "collision.fcl"}) {
    bool offered = false;
    for (const CatalogEntry& o : test::plugins().catalog()) offered = offered || o.id == engine;
    if (!offered) continue;
    SCOPED_TRACE(engine);
    World w;
    Shape shape{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
    const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
      b.base("body");
      Inertia inertia = test::solid_box(1, {0.2, 0.2, 0.2});
      inertia.com.x() = 5;
      b.set(keys::inertial, inertia);
      shape.mesh = b.intern(file);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
    });
    const RobotView& r = w.add("far", tree, {{-5, 0, 0.15}, Quat::Identity()});
    const Shape table = test::with(Shape::box({2, 2, 0.1}), 0.5);
    w.world().add_scenery("table", {}, std::span<const Shape>(&table, 1));
    w.use("motion.simplified", 1000, w.all_robots());
    w.use("scene.bvh", 0, {});
    w.use(engine, 0, {});
    w.use("contact.penalty", 0, {});
    w.use_kinematics();
    ::testing::internal::CaptureStdout();
    w.build();
    w.run_for(1);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_NEAR(w.pose(r).position.z(), 0.15, 5e-3) << "it rests on the table";
  }
}

}  // namespace
}  // namespace muro::engines
