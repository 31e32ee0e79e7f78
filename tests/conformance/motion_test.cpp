// SPDX-License-Identifier: MIT
// Requirements on every motion algorithm, at any level of detail.
#include <gtest/gtest.h>

#include "tests/conformance/team.hpp"

namespace muro {
namespace {

class EveryMotion : public ::testing::TestWithParam<std::string> {};
class EveryMotionOfVehicles : public EveryMotion {};
class EveryKinematicMotion : public EveryMotion {};

TEST_P(EveryMotion, StartsWhereTheModelIsPut) {
  test::Team team(GetParam(), 3);
  for (const RobotView* r : team.rovers)
    EXPECT_LT((team.pose(*r).position - team.world().value(r->base(), keys::initial_pose).position).norm(), 1e-12);
}

TEST_P(EveryMotionOfVehicles, FollowsABaseCommandForwards) {
  test::Team team(GetParam(), 1);
  team.world().value(team.rovers[0]->base(), keys::command_twist) = {{0.5, 0, 0}, Vec3::Zero()};
  team.run_for(2);
  const Vec3 moved = team.pose(*team.rovers[0]).position;
  EXPECT_NEAR(moved.x(), 1.0, 0.1) << "2 s at 0.5 m/s, less what a level with dynamics needs to gather speed";
  EXPECT_NEAR(moved.y(), 0, 0.02);
  EXPECT_NEAR(moved.z(), team.world().value(team.rovers[0]->base(), keys::initial_pose).position.z(), 0.005);
}

TEST_P(EveryMotion, TwistIsTheDerivativeOfPose) {
  test::Team team(GetParam(), 3);
  team.run_for(1);
  for (const RobotView* r : team.rovers) {
    const Pose before = team.pose(*r);
    const Twist v = team.twist(*r);
    team.run_for(0.001);
    const Twist after = team.twist(*r);
    const Vec3 mean = 0.5 * (v.linear + after.linear);
    EXPECT_LT(((team.pose(*r).position - before.position) / 0.001 - mean).norm(), 2e-3) << r->name;
    const Eigen::AngleAxisd turn(team.pose(*r).orientation * before.orientation.conjugate());
    EXPECT_LT((turn.angle() * turn.axis() / 0.001 - 0.5 * (v.angular + after.angular)).norm(), 2e-2) << r->name;
  }
}

TEST_P(EveryMotion, KeepsOrientationsUnitAndAllValuesFinite) {
  test::Team team(GetParam());
  for (int i = 0; i < 20; ++i) {
    team.run_for(0.5);
    for (const RobotView* r : team.rovers) {
      ASSERT_TRUE(team.pose(*r).position.allFinite());
      ASSERT_NEAR(team.pose(*r).orientation.norm(), 1, 1e-9);
    }
  }
}

TEST_P(EveryKinematicMotion, StopsAtAWallWhenItIsToldTo) {
  for (const bool stop : {false, true}) {
    test::Scene s;
    s.add_ground();
    const Shape wall = Shape::box({0.2, 10, 2});
    s.world().add_scenery("wall", {{4, 0, 1}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
    const test::Vehicle vehicle = test::vehicle_for(GetParam());
    const RobotTree model = s.read_model(MURO_TEST_SOURCE_DIR "/examples/models/" + vehicle.model + ".urdf");
    const RobotView& r = s.add("r", model, {{0, 0, model.standing_height()}, Quat::Identity()});
    s.use(GetParam(), 1000, s.all_robots(), {{"on_contact", std::string(stop ? "stop" : "ignore")}});
    s.use(vehicle.drive, 0, s.all_robots());
    s.use_contacts();
    s.build();
    s.world().value(r.base(), keys::command_twist) = {{0.5, 0, 0}, Vec3::Zero()};
    s.run_for(10);
    if (!stop) {
      EXPECT_NEAR(s.pose(r).position.x(), 5, 0.05);
      continue;
    }
    EXPECT_LT(s.pose(r).position.x(), 3.9);
    EXPECT_GT(s.pose(r).position.x(), 1);
    EXPECT_EQ(s.twist(r).linear.norm(), 0);
    s.world().value(r.base(), keys::command_twist) = {{-0.5, 0, 0}, Vec3::Zero()};
    const double before = s.pose(r).position.x();
    s.run_for(1);
    EXPECT_NEAR(s.pose(r).position.x(), before - 0.5, 0.02) << "it can back away";
  }
}

/// Returns the motions for any robot with or without wheels.
std::vector<std::string> motions_of_vehicles() {
  std::vector<std::string> some = test::algorithms_of("motion");
  std::erase_if(some, test::names_parts);
  return some;
}

/// Returns the motions of vehicles that use no forces.
std::vector<std::string> kinematic_motions() {
  std::vector<std::string> some = motions_of_vehicles();
  std::erase_if(some, [](const std::string& id) {
    return (test::plugins().algorithm(id).description->features & feature_forces) != 0;
  });
  return some;
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryMotion, ::testing::ValuesIn(test::algorithms_of("motion")), test::name_of);
INSTANTIATE_TEST_SUITE_P(Conformance, EveryMotionOfVehicles, ::testing::ValuesIn(motions_of_vehicles()), test::name_of);
INSTANTIATE_TEST_SUITE_P(Conformance, EveryKinematicMotion, ::testing::ValuesIn(kinematic_motions()), test::name_of);

}  // namespace
}  // namespace muro
