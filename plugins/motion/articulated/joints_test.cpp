// SPDX-License-Identifier: MIT
// Joints: drives, friction, limits and stops, and joints that follow others, compared with closed forms.
#include "articulated_testing.hpp"

namespace muro::articulated::testing {
namespace {

constexpr double mass = 2, dt = 1e-3;

/// A mass on a slide of a fixed base.
struct Slide : World {
  Slide(const Vec3& axis, const JointLimits& limits, const std::string& mode, double start = 0,
        Parameters parameters = {}) {
    add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("rail");
          b.set(keys::inertial, test::solid_box(5, {1, 0.1, 0.1}));
          b.prismatic("slide", axis, limits);
          b.body("carriage");
          b.set(keys::inertial, test::solid_box(mass, {0.1, 0.1, 0.1}));
        }));
    world().set(world().object("r/slide"), keys::initial_joint_position, start);
    parameters["joints"] = mode;
    parameters["base"] = std::string("fixed");
    World::start(std::move(parameters));
  }
  double& target(const Key<double>& key) { return of("r/slide", key); }
  double q() { return World::q("r/slide"); }
  double v() { return World::v("r/slide"); }
  double effort() { return of("r/slide", keys::joint_effort); }
};

TEST(AJoint, WithAPositionDriveSagsByItsLoadOverItsStiffness) {
  Slide s(Vec3::UnitZ(), {}, "position", 0, {{"stiffness", 400.0}, {"damping", 60.0}});
  s.target(keys::joint_position_target) = 0.2;
  s.run_for(5);
  EXPECT_NEAR(s.q(), 0.2 - mass * g / 400, 1e-12);
  EXPECT_NEAR(s.effort(), mass * g, 1e-9);
}

TEST(AJoint, IsHeldByItsFrictionToTheLastBit) {
  Slide s(Vec3::UnitZ(), {.friction = 1.001 * mass * g}, "passive", 0.3);
  s.run_for(3);
  EXPECT_EQ(s.q(), 0.3);
  EXPECT_EQ(s.v(), 0);
}

TEST(AJoint, SlidesAgainstItsFriction) {
  Slide s(Vec3::UnitZ(), {.friction = 0.4 * mass * g}, "passive");
  s.run_for(1);
  EXPECT_NEAR(s.v(), -0.6 * g, 1e-9);
  EXPECT_NEAR(s.q(), -0.5 * 0.6 * g, 1e-9);
}

TEST(AJoint, ComesToRestByItsFriction) {
  Slide s(Vec3::UnitX(), {.friction = 3}, "passive");
  s.of("r/slide", keys::joint_velocity) = 1.5;
  s.run_for(2);
  EXPECT_EQ(s.v(), 0) << "after m v / F = 1 s";
  EXPECT_NEAR(s.q(), 0.5 * mass * 1.5 * 1.5 / 3, 1.5 * dt);
}

TEST(AJoint, IsDampedExponentially) {
  Slide s(Vec3::UnitX(), {.damping = 5}, "passive");
  s.of("r/slide", keys::joint_velocity) = 3;
  s.run_for(1);
  EXPECT_NEAR(s.v(), 3 * std::pow(1 + 5 * dt / mass, -1000), 1e-12) << "backward Euler";
  Slide stiff(Vec3::UnitX(), {.damping = 1e9}, "passive");
  stiff.of("r/slide", keys::joint_velocity) = 3;
  stiff.run_for(0.1);
  EXPECT_LT(std::abs(stiff.v()), 1e-12) << "stable however strong";
}

TEST(AJoint, IsDrivenByNoMoreThanItsEffort) {
  Slide s(Vec3::UnitX(), {.velocity = 4, .effort = 6}, "velocity");
  s.target(keys::joint_velocity_target) = 100;
  s.run_for(1);
  EXPECT_NEAR(s.v(), 6 / mass, 1e-9);
  EXPECT_NEAR(s.effort(), 6, 1e-9);
  s.run_for(1);
  EXPECT_NEAR(s.v(), 4, 1e-9) << "the greatest speed";
}

TEST(AJoint, GivesWayToALoadThatIsTooHeavy) {
  Slide s(Vec3::UnitZ(), {.effort = 0.75 * mass * g}, "velocity");
  s.run_for(1);
  EXPECT_NEAR(s.v(), -0.25 * g, 1e-9);
  Slide holds(Vec3::UnitZ(), {.effort = 1.01 * mass * g}, "velocity");
  holds.run_for(1);
  EXPECT_EQ(holds.q(), 0);
  EXPECT_NEAR(holds.effort(), mass * g, 1e-9);
}

TEST(AJoint, WithAPositionDriveIsNoFasterThanItsLimit) {
  Slide s(Vec3::UnitX(), {.velocity = 0.5, .effort = 6}, "position", 0, {{"stiffness", 400.0}, {"damping", 60.0}});
  s.target(keys::joint_position_target) = 2;
  double fastest = 0;
  for (int k = 0; k < 300; ++k) {
    s.run_for(0.01);
    fastest = std::max(fastest, s.v());
  }
  EXPECT_NEAR(fastest, 0.5, 1e-9);
  s.run_for(5);
  EXPECT_NEAR(s.q(), 2, 1e-6);
}

TEST(AJoint, StopsDeadAtItsStop) {
  Slide s(Vec3::UnitX(), {.upper = 0.25}, "passive");
  s.of("r/slide", keys::joint_velocity) = 2;
  double highest = 0;
  for (int k = 0; k < 500; ++k) {
    s.run_for(dt);
    highest = std::max(highest, s.q());
  }
  EXPECT_LT(highest, 0.25 + 1e-12);
  EXPECT_NEAR(s.q(), 0.25, 1e-9);
  EXPECT_NEAR(s.v(), 0, 1e-12);
}

TEST(AJoint, LeavesItsStop) {
  Slide s(Vec3::UnitX(), {.lower = -0.1, .upper = 0.25}, "effort");
  s.target(keys::joint_effort_target) = 8;
  s.run_for(1);
  EXPECT_NEAR(s.q(), 0.25, 1e-9);
  s.target(keys::joint_effort_target) = -8;
  s.run_for(0.25);
  EXPECT_NEAR(s.v(), -0.25 * 8 / mass, 1e-9);
}

/// Two wheels about parallel axes of a fixed base; the second follows the first.
struct Geared : World {
  static constexpr double first = 0.3, second = 0.02, ratio = -4;
  explicit Geared(const std::string& mode) {
    add("r", test::tree_of([](RobotBuilder& b) {
          b.base("frame");
          b.set(keys::inertial, test::solid_box(5, {1, 0.1, 0.1}));
          b.fork();
          b.revolute("leader", Vec3::UnitZ(), {});
          b.body("gear");
          b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.2, .iyy = 0.2, .izz = first});
          b.end();
          b.translation({0.4, 0, 0});
          b.revolute("follower", Vec3::UnitZ(), {});
          b.mimic("leader", ratio, 0.1);
          b.body("pinion");
          b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.02, .iyy = 0.02, .izz = second});
          b.end();
        }));
    start({{"joints", mode}, {"base", std::string("fixed")}});
  }
};

TEST(AMimicJoint, AddsItsInertiaTimesTheSquareOfItsRatio) {
  Geared s("effort");
  s.of("r/leader", keys::joint_effort_target) = 1.5;
  s.run_for(1);
  const double inertia = Geared::first + Geared::ratio * Geared::ratio * Geared::second;
  EXPECT_NEAR(s.v("r/leader"), 1.5 / inertia, 1e-9);
  EXPECT_NEAR(s.v("r/follower"), Geared::ratio * s.v("r/leader"), 1e-9);
  EXPECT_NEAR(s.q("r/follower"), 0.1 + Geared::ratio * s.q("r/leader"), 1e-12);
}

/// Two fingers are on slides along x, and the right one follows the left one. Between them is a block that rests on
/// nothing.
TEST(AMimicJoint, OfAGripperHoldsABlockByFriction) {
  World w;
  const Shape pad = test::with(Shape::box({0.02, 0.1, 0.1}), 0.8);
  w.add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("palm");
          b.set(keys::inertial, test::solid_box(1, {0.3, 0.1, 0.05}));
          for (const bool left : {true, false}) {
            if (left) b.fork();
            b.translation({left ? 0.1 : -0.1, 0, -0.1});
            b.prismatic(left ? "left" : "right", Vec3(left ? -1 : 1, 0, 0), {.lower = 0, .upper = 0.08});
            if (!left) b.mimic("left", 1, 0);
            b.body(left ? "left_finger" : "right_finger");
            b.set(keys::inertial, test::solid_box(0.1, {0.02, 0.1, 0.1}));
            b.set_array(keys::collision_shapes, std::span<const Shape>(&pad, 1));
            b.end();
          }
        }),
        {{0, 0, 1}, Quat::Identity()});
  const std::vector<Item> gripper = w.all_robots();
  const RobotView& block = w.add("block", test::block(0.2, {0.1, 0.05, 0.05}, 0.8), {{0.01, 0, 0.9}, Quat::Identity()});
  w.use("motion.articulated", 1000, gripper, {{"joints", std::string("effort")}, {"base", std::string("fixed")}});
  w.use("motion.articulated", 1000, {w.all_robots().back()});
  w.world().set(w.world().object("r/left"), keys::initial_joint_position, 0.035);
  w.use_contacts();
  w.build();
  w.of("r/left", keys::joint_effort_target) = 20;  // 10 N at each finger; 1.25 N are needed
  w.run_for(1);
  const Vec3 before = w.pose(block).position;
  EXPECT_NEAR(before.x(), 0, 2e-3) << "both fingers are as far from the middle";
  EXPECT_GT(before.z(), 0.85) << "it has not fallen";
  w.run_for(1);
  EXPECT_LT((w.pose(block).position - before).norm(), 1e-3) << "it is held";
}

TEST(AJoint, StepsWithoutStrayForcesWhereArmatureIsFelt) {
  Slide s(Vec3::UnitX(), {.armature = 1.5}, "effort");
  s.target(keys::joint_effort_target) = 7;
  s.run_for(1);
  EXPECT_NEAR(s.v(), 7 / (mass + 1.5), 1e-9);
}

}  // namespace
}  // namespace muro::articulated::testing
