// SPDX-License-Identifier: MIT
// The match: a short one, and one without opponents that ends with a goal.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string file = MURO_TEST_SOURCE_DIR "/examples/soccer/match.yaml";

std::vector<double> told(const Simulation& s, const std::string& name) {
  const auto values = s.world().values(world_object, Key<double>{name, "1", ""});
  return {values.begin(), values.end()};
}

/// Only the foremost players have cameras.
const std::vector<std::string> two_cameras = {"robots.blue[0-1].camera=off", "robots.red[0-1].camera=off",
                                              "robots.blue_keeper.camera=off", "robots.red_keeper.camera=off"};

TEST(Match, ForwardsSeeTheBallAndGoForIt) {
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
    EXPECT_LT(distance, std::string(name) == "blue_2" ? 0.72 : 1.05) << name << " comes nearer";
  }
}

TEST(SlowMatch, AForwardAloneScores) {
  const std::string without_red =
      R"(algorithms.referee.inputs=["ball.pose=ball/body:pose", "left.poses=blue*/base_link:pose", )"
      R"("place.answer=ball/body:place.answer"])";
  for (const char* seed : {"seed=1", "seed=2"}) {
    BuiltScenario built =
        build(read_scenario(file, {seed, "robots.red=off", "robots.red_keeper=off", "robots.blue_keeper=off",
                                   "robots.blue[0-1].camera=off", "robots.blue[0-1].play=off",
                                   "robots.blue[0-1].walk=off", without_red}),
              test::plugins());
    Simulation& s = *built.simulation;
    while (told(s, "match.score")[0] == 0 && told(s, "match.state")[0] != 2) s.run_for(1);
    EXPECT_EQ(told(s, "match.score"), (std::vector<double>{1, 0})) << seed;
    EXPECT_EQ(told(s, "match.falls"), (std::vector<double>{0, 0})) << seed;
  }
}

}  // namespace
}  // namespace muro::host
