// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/hills.hpp"

namespace muro {
namespace {

/// A ball with two motions, which level.rules chooses, and a second ball that motion.point moves.
struct Ruled : test::Scene {
  const RobotView *ball, *other;

  /// `add_more`: adds to the scene before it is built.
  explicit Ruled(std::vector<std::string> rules, const Vec3& other_at = {5, 0, 0.1},
                 const std::function<void(World&)>& add_more = {}, double dwell = 0.1) {
    Shape shape = Shape::sphere(0.1);
    const RobotTree tree = test::single_body(shape, {.mass = 1, .ixx = 0.004, .iyy = 0.004, .izz = 0.004});
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    ball = &add("ball", tree, {{0, 0, 0.1}, Quat::Identity()}, {{0.5, 0, 0}, Vec3::Zero()});
    other = &add("other", tree, {other_at, Quat::Identity()});
    use("motion.point", 1000, {{ball, ball->base(), 0}});
    use("motion.simplified", 1000, {{ball, ball->base(), 1}});
    use("motion.point", 1000, {{other, other->base()}});
    set_levels(*ball, {"far", "near"}, 0);
    use("level.rules", 100, {{ball, ball->base()}}, {{"rules", std::move(rules)}, {"dwell", dwell}});
    if (add_more) add_more(world());
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

/// Returns the time (s) at which the level becomes 1, or -1 after 4 s. The ball moves along x at 0.5 m/s, from x = 0.
double time_of_change(Ruled& s) {
  for (int k = 0; k < 400; ++k) {
    s.run_for(0.01);
    if (s.level() == 1) return 1e-9 * double(s.now());
  }
  return -1;
}

/// Returns a function that adds a solid to the scenery.
std::function<void(World&)> solid(const Shape& shape, const Pose& pose) {
  return [shape, pose](World& world) { world.add_scenery("rock", pose, std::span<const Shape>(&shape, 1)); };
}

TEST(LevelRules, MeasureToTheNearestPointOfScenery) {
  const Quat lying(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()));  // its axis, z, is along -y
  const struct {
    Shape shape;
    Pose pose;
    double surface;  ///< x of the surface on the path of the ball
  } solids[] = {
      {Shape::box({0.2, 20, 2}), {{2, 8, 1}, Quat::Identity()}, 1.9},
      {Shape::sphere(3), {{4.5, 0, 0.1}, Quat::Identity()}, 1.5},
      {Shape::cylinder(0.5, 20), {{2, 8, 0.1}, lying}, 1.5},
      {Shape::capsule(0.5, 20), {{2, 8, 0.1}, lying}, 1.5},
  };
  for (const auto& [shape, pose, surface] : solids) {
    Ruled s({"near when nearer than 0.8 to rock"}, {50, 0, 0.1}, solid(shape, pose));
    EXPECT_NEAR(time_of_change(s), (surface - 0.8) / 0.5, 0.021) << int(shape.kind);
  }
  Ruled ground({"near when nearer than 0.2 to rock"}, {50, 0, 0.1}, solid(Shape::plane(), {}));
  EXPECT_LT(time_of_change(ground), 0.03) << "0.1 m above it";
}

TEST(LevelRules, TakeAHeightmapAsTheBoxAroundIt) {
  // hills from x = 2 on, between 1 and 3 m high
  const test::Hills hills(4, 8, [](double x, double) { return 2 + 0.5 * x; });
  const Shape shape{.kind = ShapeKind::heightmap, .size = {4, 4, 1}};
  const auto add_hills = [&](World& world) {
    Shape there = shape;
    there.mesh = world.intern(hills.path());
    world.add_scenery("hills", {{4, 0, 0}, Quat::Identity()}, std::span<const Shape>(&there, 1));
  };
  Ruled s({"near when nearer than 1 to hills"}, {50, 0, 0.1}, add_hills);
  EXPECT_NEAR(time_of_change(s), (2 - std::sqrt(1 - 0.9 * 0.9)) / 0.5, 0.021) << "its edge is 0.9 m above the ball";
}

std::function<void(World&)> yard(double x, double y, double width, double depth) {
  return [=](World& world) {
    const TextId names[] = {world.intern("yard"), world.intern("yard")};
    const double rectangles[] = {x, y, width, depth, 40, 40, 1, 1};
    world.set_array(world_object, Key<TextId>{"place.names", "1", ""}, std::span<const TextId>(names));
    world.set_array(world_object, Key<double>{"place.rectangles", "m", ""}, std::span<const double>(rectangles));
  };
}

TEST(LevelRules, KnowWhatIsInsideAPlaceAndHowFarItIs) {
  Ruled inside({"near when inside yard", "far when outside yard"}, {50, 0, 0.1}, yard(1, 0, 0.6, 0.4));
  EXPECT_NEAR(time_of_change(inside), 0.7 / 0.5, 0.021);
  inside.run_for(1.4);  // moves to 1.3 m and beyond
  EXPECT_EQ(inside.level(), 0u) << "it has left the place";
  Ruled near({"near when nearer than 0.5 to yard"}, {50, 0, 0.1}, yard(1, 0.6, 0.6, 0.4));
  // the nearest corner is at (0.7, 0.4)
  EXPECT_NEAR(time_of_change(near), (0.7 - 0.3) / 0.5, 0.021);
}

TEST(LevelRules, KeepAMotionThatATargetHasChosen) {
  Ruled s({}, {50, 0, 0.1}, {}, 0.3);
  s.world().value(s.ball->base(), keys::motion_level_target) = 1;
  s.run_for(0.02);
  EXPECT_EQ(s.level(), 1u);
  s.world().value(s.ball->base(), keys::motion_level_target) = 0;
  s.run_for(0.25);
  EXPECT_EQ(s.level(), 1u) << "it dwells";
  s.run_for(0.06);
  EXPECT_EQ(s.level(), 0u);
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
    EXPECT_SAYS(std::string(e.what()),
                "no other robot, no object of the scenery and no place has this name (did you mean `other`?)");
  }
}

TEST(LevelRules, ThatNameAPlaceWrongOrTwiceAreRefused) {
  const auto refusal = [](const std::string& rule) -> std::string {
    try {
      Ruled s({rule}, {5, 0, 0.1}, [](World& world) {
        yard(1, 0, 1, 1)(world);
        solid(Shape::sphere(1), {{9, 0, 0}, Quat::Identity()})(world);
        const Shape box = Shape::box({1, 1, 1});
        world.add_scenery("yard", {{9, 9, 0}, Quat::Identity()}, std::span<const Shape>(&box, 1));
      });
    } catch (const std::exception& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_SAYS(refusal("near when inside yrd"),
              "names `yrd`, but there is no place of this name (did you mean `yard`?); places (`world: {places: "
              "...}`): `yard`");
  EXPECT_SAYS(refusal("near when inside rock"), "names `rock`, but there is no place of this name");
  EXPECT_SAYS(refusal("near when nearer than 1 to rok"), "did you mean `rock`?");
  EXPECT_SAYS(refusal("near when nearer than 1 to yard"),
              "names `yard`, which is a place and an object of the scenery; give one of the two another name");
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
