// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"

namespace muro {
namespace {

using Settings = std::map<std::string, ParameterInput>;

/// An arm of 1 kg and 1 m, along x, that turns about y at the end of a base of 2 kg.
RobotTree base_with_arm() {
  return test::tree_of([](RobotBuilder& b) {
    const Shape box = Shape::box({0.2, 0.1, 0.1});
    b.base("base");
    b.set(keys::inertial, test::solid_box(2, {0.2, 0.2, 0.2}));
    b.set_array<Shape>(keys::collision_shapes, std::span(&box, 1));
    b.revolute("hinge", Vec3::UnitY(), {});
    b.body("arm");
    Inertia arm = test::solid_box(1, {1, 0.1, 0.1});
    arm.com = {0.5, 0, 0};
    b.set(keys::inertial, arm);
    b.set_array<Shape>(keys::collision_shapes, std::span(&box, 1));
  });
}

/// A robot in the air, some of whose links are lifted.
struct Lifted : test::Scene {
  const RobotView& robot;
  Lifted(const RobotTree& tree, const std::string& motion, Settings settings, Settings of_motion = {})
      : robot(add("robot", tree, {{0, 0, 5}, Quat::Identity()})) {
    use(motion, 1000, all_robots(), std::move(of_motion));
    use("drive.gravity_compensation", 0, all_robots(), std::move(settings));
    use_contacts();
    build();
  }
  double angle() { return world().value("robot/hinge", keys::joint_position); }
};

const char* const motions[] = {"motion.simplified", "motion.articulated", "motion.ode", "motion.bullet",
                               "motion.mujoco"};

class GravityCompensation : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(AtEveryMotion, GravityCompensation, testing::ValuesIn(motions),
                         [](const auto& m) { return std::string(m.param).substr(7); });

TEST_P(GravityCompensation, HoldsABodyThatWouldFall) {
  Lifted s(test::block(3, {0.2, 0.3, 0.4}, 0.5), GetParam(), {});
  s.run_for(1);
  EXPECT_NEAR(s.pose(s.robot).position.z(), 5, 1e-9);
}

TEST_P(GravityCompensation, OfTwiceTheWeightRisesAsFastAsItWouldFall) {
  Lifted s(test::block(3, {0.2, 0.3, 0.4}, 0.5), GetParam(), {{"fraction", 2.0}});
  s.run_for(1);
  EXPECT_NEAR(s.pose(s.robot).position.z(), 5 + 0.5 * 9.81, 0.006) << "half a step of 1 ms at 9.81 m/s at most";
  EXPECT_NEAR(s.twist(s.robot).linear.z(), 9.81, 0.006);
}

/// A pendulum without weight keeps its angle; with its weight it falls, from level at 3/2 g / (1 m).
TEST_P(GravityCompensation, OfAnArmLeavesItWhereItIs) {
  Lifted held(base_with_arm(), GetParam(), {{"links", std::vector<std::string>{"arm"}}},
              {{"base", std::string("fixed")}, {"joints", std::string("passive")}});
  held.run_for(0.5);
  EXPECT_NEAR(held.angle(), 0, 1e-6);
  Lifted half(base_with_arm(), GetParam(), {{"links", std::vector<std::string>{"arm"}}, {"fraction", 0.5}},
              {{"base", std::string("fixed")}, {"joints", std::string("passive")}});
  half.run_for(0.1);
  const double inertia = 1.0 / 12 * (1 + 0.01) + 0.25, acceleration = 0.5 * 0.5 * 9.81 / inertia;
  EXPECT_NEAR(half.angle(), 0.5 * acceleration * 0.01, 4e-4);
}

/// The robot of 3 kg falls with the weight of 2 kg.
TEST_P(GravityCompensation, OfOnePartLetsAllFallMoreSlowly) {
  Lifted s(base_with_arm(), GetParam(), {{"links", std::vector<std::string>{"arm"}}},
           {{"joints", std::string("passive")}});
  s.run_for(0.05);
  const Pose base = s.pose(s.robot);
  const double pitch = s.angle() + 2 * std::asin(base.orientation.y());
  const double centre = base.position.z() - 0.5 * std::sin(pitch) / 3;
  EXPECT_NEAR(centre, 5 - 0.5 * 9.81 * 2 / 3 * 0.05 * 0.05, 4e-4);
}

TEST(GravityCompensationOf, ALinkThatIsNotThereIsAnErrorThatListsThem) {
  try {
    Lifted s(base_with_arm(), "motion.articulated", {{"links", std::vector<std::string>{"leg"}}});
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("`leg` of `links` is no body of `robot`; it has `base`, `arm`"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace muro
