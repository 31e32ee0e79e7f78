// SPDX-License-Identifier: MIT
// Runs end when a body is too fast or too deep in scenery, and not otherwise.
#include <cmath>

#include "tests/engines/engine_scene.hpp"

namespace muro::engines {
namespace {

using test::ball;

class TheWatch : public ::testing::TestWithParam<std::string> {
 protected:
  World w;
};

TEST_P(TheWatch, EndsARunAtTheSpeedThatItIsGiven) {
  w.add("ball", ball(1, 0.1, 0.5), {{0, 0, 100}, Quat::Identity()});
  w.start(GetParam(), {{"watch_speed", 5.0}});
  EXPECT_EQ(w.failure_in(0.5), "no complaint") << "g t = 4.905 m/s";
  const std::string failure = w.failure_in(0.1);
  EXPECT_SAYS(failure, "`ball`: its base moves at 5.0");
  EXPECT_SAYS(failure, "m/s, beyond the 5 m/s of its `watch_speed`");
  EXPECT_SAYS(failure, "at t = 0.5");
  EXPECT_SAYS(failure, "Likely cause: ");
  EXPECT_SAYS(failure, "`watch: off`");
}

TEST_P(TheWatch, LooksAwayWhenItIsOff) {
  w.add("ball", ball(1, 0.1, 0.5), {{0, 0, 100}, Quat::Identity()});
  w.start(GetParam(), {{"watch", std::string("off")}, {"watch_speed", 5.0}});
  EXPECT_EQ(w.failure_in(1), "no complaint");
}

TEST_P(TheWatch, LetsBodiesFallForever) {
  const RobotView& r = w.add("ball", ball(1, 0.1, 0.5), {{0, 0, 100}, Quat::Identity()}, {{3, 0, 2}, {20, 0, 0}});
  w.start(GetParam());
  EXPECT_EQ(w.failure_in(40), "no complaint");
  EXPECT_NEAR(w.twist(r).linear.z(), 2 - 9.81 * 40, 0.01);
}

TEST_P(TheWatch, LetsAFallReboundWithAllItsSpeed) {
  w.add_ground();
  w.add("ball", ball(1, 0.5, 0, 1), {{0, 0, 2000.5}, Quat::Identity()});
  w.start(GetParam());
  EXPECT_EQ(w.failure_in(25), "no complaint") << "its impact on the ground is after 20.2 s at 198 m/s";
}

TEST_P(TheWatch, EndsARunAtTheDepthThatItIsGiven) {
  w.add_ground();
  w.add("ball", ball(1, 0.1, 0.5), {{0, 0, 1.005}, Quat::Identity()}, {{0, 0, -10}, Vec3::Zero()});
  w.start(GetParam(), {{"watch_depth", 1e-4}});
  const std::string failure = w.failure_in(1);
  EXPECT_SAYS(failure, "m deep in `ground`, beyond the 0.0001 m of its `watch_depth`");
  EXPECT_SAYS(failure, "`ball");
}

TEST_P(TheWatch, GoesOnFromASnapshotAsFromAStart) {
  w.add("ball", ball(1, 0.1, 0.5), {{0, 0, 100}, Quat::Identity()});
  w.start(GetParam());
  w.run_for(15);
  const Snapshot fast = w.snapshot();
  w.run_for(0.1);
  w.restore(fast);
  EXPECT_EQ(w.failure_in(5), "no complaint") << "at 147 m/s, which it had when the watch began";
}

INSTANTIATE_TEST_SUITE_P(Engines, TheWatch, ::testing::ValuesIn(all_motions()), name_of);

class TheWatchOfAnEngine : public ::testing::TestWithParam<std::string> {};

TEST_P(TheWatchOfAnEngine, NamesTheJointWhoseLinkIsTooFast) {
  World w;
  w.add("crank", test::tree_of([](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, test::solid_box(1, {0.2, 0.2, 0.2}));
          b.revolute("spin", Vec3::UnitZ(), {});
          b.body("arm");
          b.set(keys::inertial, test::solid_box(1, {1, 0.1, 0.1}));
          const Shape arm = Shape::box({1, 0.1, 0.1});
          b.set_array(keys::collision_shapes, std::span<const Shape>(&arm, 1));
        }));
  w.start(GetParam(), {{"base", std::string("fixed")}, {"joints", std::string("effort")}});
  w.world().value("crank/spin", keys::joint_effort_target) = 1000;
  const std::string failure = w.failure_in(10);
  EXPECT_SAYS(failure, "`crank`: what `crank/spin` carries moves at ");
  EXPECT_SAYS(failure, "that its drives, start and fall explain");
}

TEST_P(TheWatchOfAnEngine, LetsARobotFlyThatSomethingPushes) {
  World w;
  const RobotView& r = w.add("rocket", ball(1, 0.1, 0.5));
  w.push(r).force = Vec3(100, 0, 0);
  w.start(GetParam());
  EXPECT_EQ(w.failure_in(10), "no complaint") << "at 1000 m/s";
}

INSTANTIATE_TEST_SUITE_P(Engines, TheWatchOfAnEngine, ::testing::ValuesIn(engine_motions()), name_of);

}  // namespace
}  // namespace muro::engines
