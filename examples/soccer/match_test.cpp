// SPDX-License-Identifier: MIT
// The match: a short one, and one without opponents that ends with a goal.
#include <gtest/gtest.h>

#include "examples/common/repeat_testing.hpp"
#include "examples/common/robot_testing.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

using example_test::hash_on;

const std::string file = MURO_TEST_SOURCE_DIR "/examples/soccer/match.yaml";

std::vector<double> told(const Simulation& s, const std::string& name) {
  return example_test::values_of(s.world(), world_object, name);
}

/// Only the foremost players have cameras.
const std::vector<std::string> two_cameras = {"robots.blue[0-1].camera=off", "robots.red[0-1].camera=off",
                                              "robots.blue_keeper.camera=off", "robots.red_keeper.camera=off"};

TEST(Match, ForwardsSeeTheBallAndOneGoesForIt) {
  BuiltScenario built = build(read_scenario(file, two_cameras), test::plugins());
  Simulation& s = *built.simulation;
  s.run_for(4.5);
  EXPECT_EQ(told(s, "match.falls"), (std::vector<double>{0, 0}));
  for (const char* name : {"blue_2", "red_2"}) {
    const ObjectId base = s.world().find_robot(name)->base();
    const auto seen = s.world().values(base, Key<double>{"ball.seen", "1, m, m, s", ""});
    EXPECT_LT(seen[3], 1) << name << " has it in sight";
    const double distance = s.world().value(base, keys::pose).position.head<2>().norm();
    EXPECT_NEAR(std::hypot(seen[1], seen[2]), distance, 0.15) << name;
    if (std::string(name) == "blue_2")
      EXPECT_LT(distance, 0.72) << "it goes for it";
    else
      EXPECT_GT(distance, 1) << "the others have the kick-off";
  }
}

TEST(Match, ThreadsDoNotMatter) { EXPECT_EQ(hash_on(1, file, two_cameras, 4), hash_on(3, file, two_cameras, 4)); }

/// A sphere that is pushed at v slides. Friction m slows it down and spins it up against the resistance to rolling, c =
/// `rolling_resistance` / radius, until it rolls: g t (7/2 m - 5/2 c) = v. From then on a = 5/7 c g.
TEST(Match, TheBallRollsToRest) {
  const std::vector<std::string> alone = {
      "robots.blue=off",        "robots.red=off",       "robots.blue_keeper=off",          "robots.red_keeper=off",
      "algorithms.referee=off", "algorithms.score=off", "robots.ball.velocity=[1.5, 0, 0]"};
  BuiltScenario built = build(read_scenario(file, alone), test::plugins());
  Simulation& s = *built.simulation;
  const double v = 1.5, g = 9.81, m = 0.5, c = 0.005 / 0.07;
  const double t = v / (g * (3.5 * m - 2.5 * c)), slides = v * t - 0.5 * m * g * t * t;
  const double rolling = v - m * g * t, rolls = rolling * rolling / (2 * c * g * 5 / 7);
  s.run_for(1);
  EXPECT_GT(s.world().value("ball/body", keys::twist).linear.x(), 0.3);
  s.run_for(4);
  EXPECT_NEAR(s.world().value("ball/body", keys::pose).position.x(), slides + rolls, 0.01 * (slides + rolls));
  EXPECT_LT(s.world().value("ball/body", keys::twist).linear.norm(), 1e-3);
}

/// Returns a match of blue's forward, with this motion, and two mates that only stand there.
BuiltScenario forward_alone(const std::string& motion, const std::string& seed = "seed=1") {
  const std::string without_red =
      R"(algorithms.referee.inputs=["ball.pose=ball/body:pose", "left.poses=blue*/base_link:pose", )"
      R"("place.answer=ball/body:place.answer"])";
  return build(read_scenario(file, {seed, "robots.blue[2].motion.use=motion." + motion, "robots.red=off",
                                    "robots.red_keeper=off", "robots.blue_keeper=off", "robots.blue[0-1].camera=off",
                                    "robots.blue[0-1].play=off", "robots.blue[0-1].walk=off", without_red}),
               test::plugins());
}

/// Returns the time (s) until it has scored.
double time_of_goal(const std::string& motion, const std::string& seed = "seed=1") {
  BuiltScenario built = forward_alone(motion, seed);
  Simulation& s = *built.simulation;
  for (int k = 0; k < 245 && told(s, "match.score")[0] == 0; ++k) s.run_for(0.5);
  EXPECT_EQ(told(s, "match.score"), (std::vector<double>{1, 0})) << motion << " " << seed;
  EXPECT_EQ(told(s, "match.falls"), (std::vector<double>{0, 0})) << motion << " " << seed;
  return 1e-9 * double(s.now());
}

TEST(SlowMatch, AForwardAloneScoresAtEachLevel) {
  for (const char* motion : {"biped", "articulated", "simplified", "mujoco", "bullet"})
    EXPECT_LT(time_of_goal(motion), 100);
  EXPECT_LT(time_of_goal("articulated", "seed=2"), 100);
}

/// A goal in this half depends on each bit of each picture: see README.md.
TEST(SlowMatch, AHalfEndsAfterKicksWithTheBallInTheField) {
  BuiltScenario built = build(read_scenario(file, {}), test::plugins());
  Simulation& s = *built.simulation;
  double rolled = 0, lowest = 1;  // m: way of the ball; height of its centre
  int kicks = 0;
  bool rolls_fast = false;
  Vec3 before = s.world().value("ball/body", keys::pose).position;
  for (int k = 0; k < 1205; ++k) {
    s.run_for(0.1);
    const Vec3 ball = s.world().value("ball/body", keys::pose).position;
    const double way = (ball - before).norm(), speed = s.world().value("ball/body", keys::twist).linear.norm();
    rolled += way < 1 ? way : 0;  // a longer way: the ball was put somewhere else
    lowest = std::min(lowest, ball.z());
    kicks += speed > 0.4 && !rolls_fast ? 1 : 0;
    rolls_fast = speed > (rolls_fast ? 0.2 : 0.4);
    before = ball;
  }
  EXPECT_EQ(told(s, "match.state")[0], 2) << "it is over";
  EXPECT_GE(kicks, 3);
  EXPECT_GT(rolled, 5);
  EXPECT_NEAR(lowest, 0.07, 0.01);
}

TEST(SlowMatch, ThreadsDoNotMatterWithAllCameras) {
  const std::uint64_t one = hash_on(1, file, {}, 15);
  for (const unsigned threads : {2u, 3u}) EXPECT_EQ(hash_on(threads, file, {}, 15), one) << threads;
}

TEST(SlowMatch, OneInAnEngineGoesForTheBallAsTheOthersDo) {
  for (const char* motion : {"mujoco", "bullet"}) {
    std::vector<std::string> overrides = two_cameras;
    overrides.push_back(std::string("robots.blue[2].motion.use=motion.") + motion);
    BuiltScenario built = build(read_scenario(file, overrides), test::plugins());
    Simulation& s = *built.simulation;
    s.run_for(6);
    const Pose& pose = s.world().value(s.world().find_robot("blue_2")->base(), keys::pose);
    EXPECT_LT(pose.position.head<2>().norm(), 0.4) << motion << ": it began at 0.8 m";
    EXPECT_GT(pose.position.z(), 0.24) << motion;
  }
}

}  // namespace
}  // namespace muro::host
