// SPDX-License-Identifier: MIT
// The robots of the example reach one heading, stay together and keep their distance.
#include <gtest/gtest.h>

#include <complex>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string scenario = MURO_TEST_SOURCE_DIR "/examples/swarm/swarm.yaml";
constexpr double diameter = 0.14;  // m, of bot.urdf

struct Flock {
  double order = 0;                        ///< |mean of exp(i heading)|: 1 when all have the same heading (Vicsek 1995)
  double nearest = 1e9, mean_nearest = 0;  ///< m: from a robot to its nearest neighbour
  double loneliest = 0;                    ///< m: the greatest of these distances
};

Flock look_at(const World& world) {
  Flock f;
  std::complex<double> headings = 0;
  const auto pose_of = [&](const RobotView* r) -> const Pose& { return world.value(r->base(), keys::pose); };
  for (const RobotView* a : world.robots()) {
    const Vec3 ahead = pose_of(a).orientation * Vec3::UnitX();
    headings += std::complex<double>(ahead.x(), ahead.y());
    double nearest = 1e9;
    for (const RobotView* b : world.robots())
      if (a != b) nearest = std::min(nearest, (pose_of(a).position - pose_of(b).position).norm());
    f.nearest = std::min(f.nearest, nearest);
    f.loneliest = std::max(f.loneliest, nearest);
    f.mean_nearest += nearest / double(world.robots().size());
  }
  f.order = std::abs(headings) / double(world.robots().size());
  return f;
}

BuiltScenario swarm(const std::vector<std::string>& overrides = {}) {
  return build(read_scenario(scenario, overrides), test::plugins());
}

/// Runs for `seconds`, and checks the flock every second: no robot touches another one or gets lost.
Flock fly(BuiltScenario& built, int seconds) {
  const World& world = built.simulation->world();
  Flock flock;
  for (int t = 0; t < seconds; ++t) {
    built.simulation->run_for(1);
    flock = look_at(world);
    EXPECT_GT(flock.nearest, diameter) << "at " << t << " s";
    EXPECT_LT(flock.loneliest, 2) << "at " << t << " s: who sees nobody is lost";
  }
  return flock;
}

TEST(Swarm, ComesToOneHeadingAndKeepsItsDistances) {
  BuiltScenario built = swarm({"seed=3"});
  ASSERT_EQ(built.simulation->world().robots().size(), 300u);
  EXPECT_LT(look_at(built.simulation->world()).order, 0.2) << "headings are random";
  const Flock flock = fly(built, 30);
  EXPECT_GT(flock.order, 0.8);
  EXPECT_NEAR(flock.mean_nearest, 0.3, 0.1);
}

TEST(SlowSwarm, FliesAsOneFlockInTheEnd) {
  for (const char* seed : {"seed=1", "seed=3"}) {
    BuiltScenario built = swarm({seed});
    EXPECT_GT(fly(built, 60).order, 0.95) << seed;
  }
}

TEST(Swarm, StaysWithoutOrderWhereRobotsLookAtNobody) {
  BuiltScenario built = swarm({"robots.bots.control.tunables=[\"alignment=0\", \"cohesion=0\"]"});
  built.simulation->run_for(10);
  EXPECT_LT(look_at(built.simulation->world()).order, 0.3);
}

}  // namespace
}  // namespace muro::host
