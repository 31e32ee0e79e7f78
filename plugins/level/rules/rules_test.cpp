// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"

namespace muro {
namespace {

/// A ball with two motions: `ruled` by rules, and a second ball that motion.point moves.
struct Ruled : test::Scene {
  const RobotView *ball, *other;

  explicit Ruled(std::vector<std::string> rules, const Vec3& other_at = {5, 0, 0.1}) {
    Shape shape = Shape::sphere(0.1);
    const RobotTree tree = test::single_body(shape, {.mass = 1, .ixx = 0.004, .iyy = 0.004, .izz = 0.004});
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    ball = &add("ball", tree, {{0, 0, 0.1}, Quat::Identity()}, {{0.5, 0, 0}, Vec3::Zero()});
    other = &add("other", tree, {other_at, Quat::Identity()});
    use("motion.point", 1000, {{ball, ball->base(), 0}});
    use("motion.simplified", 1000, {{ball, ball->base(), 1}});
    use("motion.point", 1000, {{other, other->base()}});
    set_levels(*ball, {"far", "near"}, 0);
    use("level.rules", 100, {{ball, ball->base()}}, {{"rules", std::move(rules)}});
    use_contacts();
    build();
    world().value(ball->base(), keys::command_twist) = {{0.5, 0, 0}, Vec3::Zero()};
  }
  std::uint32_t level() { return world().value(ball->base(), keys::motion_level); }
};

TEST(LevelRules, HandOverAtATime) {
  Ruled s({"near at 0.5", "far at 1"});
  s.run_for(0.5);
  EXPECT_EQ(s.level(), 0u);
  s.run_for(0.01);
  EXPECT_EQ(s.level(), 1u);
  EXPECT_EQ(s.world().value(s.ball->base(), keys::contact_world), keys::contact_for_all);
  s.run_for(0.5);
  EXPECT_EQ(s.level(), 0u);
  EXPECT_EQ(s.world().value(s.ball->base(), keys::contact_world), 0u);
  EXPECT_NEAR(s.pose(*s.ball).position.x(), 0.5 * 1.01, 1e-12) << "the hand-over keeps the pose";
}

TEST(LevelRules, HandOverWhereRobotsComeNear) {
  Ruled s({"near when nearer than 1 to other", "far when farther than 1.5 from other"}, {2, 1e-9, 0.1});
  s.run_for(1.9);
  EXPECT_EQ(s.level(), 0u);
  s.run_for(0.2);  // 2 - 0.5 t < 1
  EXPECT_EQ(s.level(), 1u);
}

TEST(LevelRules, HandOverOnContact) {
  Ruled s({"near when in contact", "far when out of contact for 0.5"}, {0.5, 0, 0.1});
  s.run_for(0.55);  // surfaces touch at 0.6 s
  EXPECT_EQ(s.level(), 0u);
  s.run_for(0.1);
  EXPECT_EQ(s.level(), 1u);
  s.world().value(s.ball->base(), keys::command_twist) = {};
  s.run_for(1);
  EXPECT_LT(s.pose(*s.ball).position.x(), 0.35) << "as a body of mass it cannot go through the other";
  EXPECT_EQ(s.level(), 0u) << "it has bounced off and was out of contact for half a second";
}

TEST(LevelRules, AMotionIsKeptForAWhile) {
  Ruled s({"near when nearer than 100 to any", "far when farther than 1 from all"});
  s.run_for(1);
  EXPECT_EQ(s.level(), 1u) << "the first rule that holds decides";
}

TEST(LevelRules, GoOnFromASnapshotToTheSameBits) {
  Ruled s({"near at 0.5", "far at 1"});
  s.run_for(0.8);
  const Snapshot middle = s.snapshot();
  s.run_for(0.7);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.7);
  EXPECT_EQ(s.state_hash(), end);
  s.reset();
  EXPECT_EQ(s.level(), 0u);
}

TEST(LevelRules, ComeBeforeATargetWhichCountsWhereNoneHolds) {
  Ruled s({"far when nearer than 1 to other"}, {2, 1e-9, 0.1});
  s.world().value(s.ball->base(), keys::motion_level_target) = 1;
  s.run_for(0.05);
  EXPECT_EQ(s.level(), 1u) << "no rule holds";
  s.world().value(s.ball->base(), keys::motion_level_target) = -1;
  s.run_for(0.05);
  EXPECT_EQ(s.level(), 1u) << "no wish";
  s.world().value(s.ball->base(), keys::motion_level_target) = 1;
  s.run_for(2.1);  // 2 - 0.5 t < 1
  EXPECT_EQ(s.level(), 0u) << "the rule holds";
  s.world().value(s.ball->base(), keys::command_twist) = {{-1, 0, 0}, Vec3::Zero()};
  s.run_for(0.5);
  EXPECT_EQ(s.level(), 1u) << "it holds no more";
}

TEST(LevelRules, OfARobotWithOneMotionAreRefused) {
  test::Scene s;
  const RobotView& r = s.add("solo", test::single_body(Shape::sphere(0.1), {.mass = 1}));
  s.use("motion.point", 100, s.all_robots());
  s.use("level.rules", 100, s.all_robots(), {{"rules", std::vector<std::string>{"near at 1"}}});
  try {
    s.build();
    FAIL() << r.name;
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("`solo` has only one motion; list several under `levels`"), std::string::npos)
        << e.what();
  }
}

TEST(LevelRules, ThatNameNoOtherRobotAreRefused) {
  try {
    Ruled s({"near when nearer than 1 to othr"});
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("no other robot has this name (did you mean `other`?)"), std::string::npos)
        << e.what();
  }
}

TEST(LevelRules, AreDeterministicAndLeaveTheSpeedOfTheRunToLevelBudget) {
  EXPECT_NE(test::plugins().algorithm("level.rules").description->capabilities & deterministic, 0u);
  try {
    Ruled s({"far when slower than 1"});
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("the rule `far when slower than 1` goes by the speed of the run, which only "
                                         "the machine's clock tells; use level.budget"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace muro
