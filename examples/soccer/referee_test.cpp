// SPDX-License-Identifier: MIT
// The referee with a ball that rolls freely, on the field of the match.
#include <gtest/gtest.h>

#include <cmath>

#include "core/instance.hpp"
#include "examples/common/repeat_testing.hpp"
#include "examples/common/robot_testing.hpp"
#include "host/scenario/builder.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// A blue player and a red one, boxes, and a ball.
struct Match {
  test::ScratchFolder folder;
  BuiltScenario built;
  Simulation& s;

  explicit Match(const std::string& ball, const std::string& blue = "{x: -2}", const std::string& tunables = "")
      : built(build(read_scenario(folder.file("match.yaml", text(ball, blue, tunables)), {}), test::plugins())),
        s(*built.simulation) {}

  static std::string text(const std::string& ball, const std::string& blue, const std::string& tunables) {
    return "world: {file: " MURO_TEST_SOURCE_DIR
           "/examples/soccer/field.sdf}\n"
           "robots:\n"
           "  blue: {shape: {box: [0.1, 0.1, 0.4]}, mass: 3, at: " +
           blue +
           ", motion: {use: motion.simplified, rate: 500}}\n"
           "  red: {shape: {box: [0.1, 0.1, 0.4]}, mass: 3, at: {x: 2}, motion: {use: motion.simplified, rate: 500}}\n"
           "  ball: {shape: {sphere: 0.07}, mass: 0.205, motion: {use: motion.simplified, rate: 500}, " +
           ball +
           ",\n    placement: {use: controller.placement, rate: 50}}\n"
           "algorithms:\n"
           "  referee:\n"
           "    use: controller.library\n"
           "    library: referee\n"
           "    rate: 50\n"
           "    tunables: [" +
           tunables +
           "]\n"
           "    inputs: [\"ball.pose=ball/body:pose\", \"left.poses=blue/body:pose\", \"right.poses=red/body:pose\",\n"
           "      \"place.answer=ball/body:place.answer\"]\n"
           "    outputs: [\"place.pose=ball/body:place.pose\", \"place.twist=ball/body:place.twist\",\n"
           "      \"place.count=ball/body:place.count\"]\n";
  }
  std::vector<double> told(const std::string& name) { return example_test::values_of(s.world(), world_object, name); }
  Vec3 ball() { return s.world().value("ball/body", keys::pose).position; }
};

using Numbers = std::vector<double>;

TEST(Referee, GivesTheKickOffToOneTeamForTenSeconds) {
  Match m("at: {x: 0, y: 0}");
  m.s.run_for(9.9);
  EXPECT_EQ(m.told("match.kick_off"), (Numbers{1})) << "the left one";
  m.s.run_for(0.2);
  EXPECT_EQ(m.told("match.kick_off"), (Numbers{0}));
}

TEST(Referee, EndsTheKickOffWhenTheBallIsInPlay) {
  Match m("at: {x: 0, y: 0}, velocity: [1, 0, 0]");
  m.s.run_for(0.05);
  EXPECT_EQ(m.told("match.kick_off"), (Numbers{1}));
  m.s.run_for(0.4);
  EXPECT_EQ(m.told("match.kick_off"), (Numbers{0}));
}

TEST(Referee, GivesTheKickOffToWhoLetAGoalIn) {
  Match m("at: {x: 4.2, y: 0.5}, velocity: [2, 0, 0]");
  m.s.run_for(0.1);
  EXPECT_EQ(m.told("match.kick_off"), (Numbers{0})) << "the ball is not on the centre mark";
  m.s.run_for(3);
  EXPECT_EQ(m.told("match.score"), (Numbers{1, 0}));
  EXPECT_EQ(m.told("match.kick_off"), (Numbers{-1}));
}

TEST(Referee, CountsAGoalAndPutsTheBallOnTheCentreMark) {
  Match m("at: {x: 4.2, y: 0.5}, velocity: [2, 0, 0]");
  m.s.run_for(0.6);
  EXPECT_EQ(m.told("match.score"), (Numbers{1, 0}));
  EXPECT_GT(m.ball().x(), 4.57) << "for a second it stays in the goal";
  m.s.run_for(1);
  EXPECT_LT(m.ball().head<2>().norm(), 1e-3);
  EXPECT_EQ(m.told("match.state"), Numbers{1});
  m.s.run_for(3);
  EXPECT_EQ(m.told("match.score"), (Numbers{1, 0})) << "it is counted once";
}

TEST(Referee, GivesTheGoalInTheWestToTheRightTeam) {
  Match m("at: {x: -4.2, y: -1.1}, velocity: [-2, 0, 0]");
  m.s.run_for(0.6);
  EXPECT_EQ(m.told("match.score"), (Numbers{0, 1}));
}

TEST(Referee, SeesNoGoalBesideThePost) {
  Match m("at: {x: 4.2, y: 2}, velocity: [2, 0, 0]");
  m.s.run_for(1.6);
  EXPECT_EQ(m.told("match.score"), (Numbers{0, 0}));
  EXPECT_EQ(m.told("match.outs"), Numbers{1});
  EXPECT_LT((m.ball().head<2>() - Eigen::Vector2d(3.5, 1.5)).norm(), 1e-3) << "the corner of the goal area";
}

TEST(Referee, ThrowsInWhereTheBallLeft) {
  Match m("at: {x: 1, y: 2.8}, velocity: [0, 2, 0]");
  m.s.run_for(1.6);
  EXPECT_EQ(m.told("match.outs"), Numbers{1});
  EXPECT_NEAR(m.ball().x(), 1, 0.01);
  EXPECT_NEAR(m.ball().y(), 3, 1e-3);
}

TEST(Referee, GivesACornerWhereTheDefenderWasLastAtTheBall) {
  Match m("at: {x: 2.1, y: 0.2}, velocity: [4, 3, 0]");  // beside red
  m.s.run_for(2.2);
  EXPECT_EQ(m.told("match.outs"), Numbers{1});
  EXPECT_LT((m.ball().head<2>() - Eigen::Vector2d(4.5, 3)).norm(), 1e-3);
}

TEST(Referee, PutsTheBallBesideWhoStandsOnTheCentreMark) {
  Match m("at: {x: 4.2, y: 0.5}, velocity: [2, 0, 0]", "{x: 0, y: 0}");
  m.s.run_for(2.5);
  EXPECT_NEAR(m.ball().head<2>().norm(), 0.25, 0.02);
}

TEST(Referee, CountsAFallOnce) {
  Match m("at: {x: 0, y: 0}", "{x: -2, roll: 1.5708}");
  m.s.run_for(0.4);
  EXPECT_EQ(m.told("match.falls"), (Numbers{0, 0})) << "not before it has lain for half a second";
  m.s.run_for(1.5);
  EXPECT_EQ(m.told("match.falls"), (Numbers{1, 0}));
}

/// Component of a trunk's axis z along "up", every 0.2 s: a humanoid of examples/walk gets up from its back. It sits,
/// bends forward over its feet, and rises.
constexpr double from_the_back[] = {0.05, 0.05, 0.05, 0.05, 0.05, 0.07, 0.20, 0.40, 0.60, 0.77, 0.90, 0.98,
                                    0.98, 0.96, 0.90, 0.86, 0.85, 0.81, 0.80, 0.77, 0.62, 0.57, 0.15, 0.19,
                                    0.52, 0.74, 0.90, 0.90, 0.96, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00};

/// Moves blue's trunk as recorded.
void get_up(Match& m) {
  const ObjectId trunk = m.s.world().object("blue/body");
  for (std::size_t i = 1; i < std::size(from_the_back); ++i)
    for (int k = 1; k <= 10; ++k) {
      const double up = std::lerp(from_the_back[i - 1], from_the_back[i], 0.1 * k);
      m.s.world().value(trunk, keys::pose) = {{-2, 0, 0.2}, from_rpy(0, std::acos(up), 0)};
      m.s.run_for(0.02);
    }
}

TEST(Referee, CountsGettingUpFromTheBackAsNoFurtherFall) {
  Match m("at: {x: 0, y: 0}");
  get_up(m);
  EXPECT_EQ(m.told("match.falls"), (Numbers{1, 0}));
  get_up(m);
  EXPECT_EQ(m.told("match.falls"), (Numbers{2, 0})) << "it has stood before it fell again";
}

TEST(Referee, FreesABallThatIsStuckAndEndsTheHalf) {
  Match m("at: {x: 1, y: 1}", "{x: -2}", "patience=2, pause=0.5, half=4");
  m.s.run_for(2.3);
  EXPECT_LT((m.ball().head<2>() - Eigen::Vector2d(1, 1)).norm(), 1e-3);
  m.s.run_for(0.7);
  EXPECT_LT(m.ball().head<2>().norm(), 1e-3);
  m.s.run_for(1.1);
  EXPECT_EQ(m.told("match.state"), Numbers{2});
}

TEST(Referee, GoesOnFromASnapshotToTheSameBits) {
  Match m("at: {x: 4.2, y: 0.5}, velocity: [2, 0, 0]");
  example_test::expect_same_bits_from_snapshot(m.s, 0.7, 1);  // in the pause
  EXPECT_LT(m.ball().head<2>().norm(), 1e-3);
}

}  // namespace
}  // namespace muro::host
