// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

const RobotTree& box() {
  static const RobotTree tree = test::single_body(Shape::box({1, 1, 1}), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
  return tree;
}

struct Drive : test::Scene {
  const RobotView& robot = add("box", box());
  explicit Drive(double rate = 100) {
    use("motion.point", rate, all_robots());
    build();
    world().value(robot.base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0.5}};
  }
};

TEST(Simulation, MovesACommandedPointAlongACircle) {
  Drive s;
  s.run_for(3);
  EXPECT_NEAR(s.pose(s.robot).position.x(), 2 * std::sin(1.5), 1e-9);
  EXPECT_NEAR(s.pose(s.robot).position.y(), 2 * (1 - std::cos(1.5)), 1e-9);
}

TEST(Simulation, RefusesTimesThatCannotBe) {
  Drive s;
  for (const double wrong : {std::nan(""), -1e-9, -1.0, 1e10, 1e300, HUGE_VAL})
    EXPECT_SAYS(test::complaint_of([&] { s.run_for(wrong); }), "the duration of a run is ");
  EXPECT_SAYS(test::complaint_of([&] { s.run_until(-1); }), "the end of a run is -1 ns");
  EXPECT_SAYS(test::complaint_of([&] { s.run_until(std::numeric_limits<std::int64_t>::max()); }), "ns but must be");
  EXPECT_EQ(s.now(), 0);
  s.run_for(0.5);
  s.run_until(0);
  EXPECT_EQ(s.now(), 500'000'000) << "what is past has been run";
  for (const double wrong : {std::nan(""), -1.0, 1e-7, 1e7, HUGE_VAL})
    EXPECT_SAYS(test::complaint_of([&] { s.set_pacing({wrong}); }), "times real time is not possible");
  EXPECT_SAYS(test::complaint_of([&] { s.use("motion.point", std::nan("")); }), "a rate of nan Hz is not possible");
}

TEST(Simulation, RunsNothingBeforeItIsBuilt) {
  test::Scene s;
  s.add("box", box());
  const auto complaint = [&](auto call) { return test::complaint_of(call); };
  EXPECT_SAYS(complaint([&] { s.run_for(1); }), "is called before build()");
  EXPECT_SAYS(complaint([&] { s.run_until(1); }), "run_until() is called before build()");
  EXPECT_SAYS(complaint([&] { s.refresh(); }), "before build()");
  EXPECT_SAYS(complaint([&] { s.finish(); }), "before build()");
  EXPECT_SAYS(complaint([&] { static_cast<void>(s.snapshot()); }), "before build()");
  EXPECT_SAYS(complaint([&] { s.restore({}); }), "before build()");
  EXPECT_SAYS(complaint([&] { s.reset(); }), "before build()");
}

TEST(Simulation, AResetIsAFreshStartToTheBit) {
  Drive s;
  Drive fresh;
  s.run_for(1);
  const std::uint64_t first = s.state_hash();
  EXPECT_NE(first, fresh.state_hash());
  s.reset();
  EXPECT_EQ(s.now(), 0);
  s.world().value(s.robot.base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0.5}};
  EXPECT_EQ(s.state_hash(), fresh.state_hash());
  s.run_for(1);
  EXPECT_EQ(s.state_hash(), first);
}

TEST(Simulation, ARestoredSnapshotGoesOnToTheSameBits) {
  Drive s(30);
  s.run_for(0.7);
  const Snapshot middle = s.snapshot();
  s.run_for(1.3);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  EXPECT_EQ(s.now(), 700'000'000);
  s.run_for(1.3);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(Simulation, TheHashDoesNotDependOnTheOrderOfRobots) {
  const auto hash = [](const std::vector<std::string>& names) {
    test::Scene s;
    for (const std::string& n : names) s.add(n, box(), {{double(n.back()), 0, 0}, Quat::Identity()});
    s.use("motion.point", 10, s.all_robots());
    s.build();
    s.run_for(1);
    return s.state_hash();
  };
  EXPECT_EQ(hash({"a", "b", "c"}), hash({"c", "a", "b"}));
  EXPECT_NE(hash({"a", "b", "c"}), hash({"a", "b", "d"}));
}

TEST(Simulation, NamesTheNearestAlgorithm) {
  test::Scene s;
  s.use("motion.pont", 10);
  try {
    s.build();
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("no plugin offers `motion.pont` (did you mean `motion.point`?)"),
              std::string::npos)
        << e.what();
  }
}

TEST(Simulation, ChecksParametersAgainstTheDescription) {
  test::Scene s;
  s.add("box", box());
  s.use("motion.point", 10, s.all_robots(),
        {{"max_sped", 1.0},
         {"max_turn_rate", -1.0},
         {"mode", std::string("fly")},
         {"max_acceleration", std::string("big")}});
  try {
    s.build();
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_STREQ(
        e.what(),
        "motion.point #0: parameter `mode` is \"fly\" but must be one of velocity, pose\n"
        "motion.point #0: parameter `max_turn_rate` is -1 but must be a number from 0 to 1e+09 rad/s\n"
        "motion.point #0: parameter `max_acceleration` is \"big\" but must be a number from 0 to 1e+09 m/s^2\n"
        "motion.point #0: `motion.point` has no parameter `max_sped` (did you mean `max_speed`?); it has: mode, "
        "max_speed, max_turn_rate, max_acceleration, max_turn_acceleration, height_above_ground, on_contact, joints");
  }
}

TEST(Simulation, TwoMotionsOfOneRobotAreTwoWriters) {
  test::Scene s;
  s.add("box", box());
  s.use("motion.point", 10, s.all_robots());
  s.use("motion.point", 20, s.all_robots());
  try {
    s.build();
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find(
                  "`box/body:pose` has two writers: motion.point #0 (motion.point) and motion.point #1 "
                  "(motion.point); only one algorithm may write a property"),
              std::string::npos)
        << e.what();
  }
}

TEST(Simulation, RefusesShapesWhoseTextsAreOfAnotherWorld) {
  test::Scene other, s;
  Shape mesh = Shape::box({1, 1, 1});
  mesh.kind = ShapeKind::mesh;
  for (const char* text : {"a.stl", "b.stl", "c.stl"}) mesh.mesh = other.world().intern(text);
  RobotTree tree;
  tree.base("body");
  tree.set_array(keys::collision_shapes, std::span<const Shape>(&mesh, 1));
  tree.close();
  const std::string told =
      "names text 3, but there are 1; texts of shapes (mesh, texture) are interned with the World or RobotTree that "
      "the "
      "shapes are given to";
  EXPECT_EQ(test::complaint_of<SetupError>([&] { s.world().add_robot("robot", tree); }),
            "`robot/body:collision.shapes` " + told);
  EXPECT_EQ(
      test::complaint_of<SetupError>([&] { s.world().add_scenery("wall", {}, std::span<const Shape>(&mesh, 1)); }),
      "`wall:collision.shapes` " + told);
}

}  // namespace
}  // namespace muro
