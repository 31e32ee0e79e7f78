// SPDX-License-Identifier: MIT
// The example of levels: robots with different motions in one scene, observed from outside.
#include <gtest/gtest.h>

#include <set>

#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/shadows.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string folder = MURO_TEST_SOURCE_DIR "/examples/levels/";

BuiltScenario open(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return build(read_scenario(folder + file, overrides), test::plugins());
}

const Pose& pose_of(const Simulation& s, const std::string& robot) {
  return s.world().value(s.world().find_robot(robot)->base(), keys::pose);
}

TEST(Levels, RoversOfAllLevelsPushABallAndBoxesAndEachOther) {
  BuiltScenario built = open("levels.yaml");
  Simulation& s = *built.simulation;
  const auto robots = s.world().robots();
  ASSERT_EQ(robots.size(), 11u);
  std::vector<Vec3> start;
  for (const RobotView* r : robots) start.push_back(s.world().value(r->base(), keys::pose).position);
  std::set<std::pair<std::string, std::string>> pairs;  // robots whose contact the contact algorithm resolved
  for (int k = 0; k < 400; ++k) {
    s.run_for(0.05);
    for (const RobotView* r : robots) {
      const Pose& pose = s.world().value(r->base(), keys::pose);
      ASSERT_TRUE(pose.position.allFinite()) << r->name;
      ASSERT_GT(pose.position.z(), 0.05) << r->name << " fell through the ground at " << 0.05 * k;
      ASSERT_LT(pose.position.z(), 0.6) << r->name << " flew up at " << 0.05 * k;
      const ObjectId base = r->base();
      if (!s.world().has(base, "contacts")) continue;
      for (const Contact& c : s.world().values(base, keys::contacts))
        if (const RobotId other = s.world().robot_of(c.other); other != no_robot)
          pairs.emplace(r->name, robots[index_of(other)]->name);
    }
  }
  for (const char* rover : {"point", "differential_drive", "simplified", "bullet", "ode", "mujoco"}) {
    const Vec3 now = pose_of(s, rover).position;
    const Vec3 before = start[index_of(s.world().find_robot(rover)->id)];
    EXPECT_LT(now.norm(), before.norm() - 0.5) << rover << " came nearer to the middle";
  }
  for (const char* thing : {"ball", "box_by_bullet", "box_by_ode", "box_by_mujoco"}) {
    const Vec3 before = start[index_of(s.world().find_robot(thing)->id)];
    EXPECT_GT((pose_of(s, thing).position - before).head<2>().norm(), 0.05) << thing << " was pushed";
  }
  EXPECT_GE(pairs.size(), 8u) << "robots of different worlds were in contact";
}

TEST(SlowLevels, GiveTheSameBitsOnTwoThreads) {
  const auto run = [](unsigned threads) {
    BuiltScenario built = open("levels.yaml");
    built.simulation->set_threads(threads);
    built.simulation->run_for(6);
    return built.simulation->state_hash();
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(SlowLevels, GoOnFromASnapshotToTheSameBits) {
  BuiltScenario built = open("levels.yaml");
  Simulation& s = *built.simulation;
  s.run_for(5);
  const Snapshot middle = s.snapshot();
  s.run_for(1);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(1);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(Levels, AGuestIsAPointFarFromTheBallAndABodyNearIt) {
  BuiltScenario built = open("handover.yaml");
  Simulation& s = *built.simulation;
  const ObjectId base = s.world().find_robot("guest")->base();
  bool was_near = false;
  for (int k = 0; k < 240; ++k) {
    s.run_for(0.05);
    const double distance = (pose_of(s, "guest").position - pose_of(s, "ball").position).norm();
    const std::uint32_t level = s.world().value(base, keys::motion_level);
    if (distance < 1.15) {
      EXPECT_EQ(level, 1u) << distance;
    }
    was_near = was_near || level == 1;
  }
  EXPECT_TRUE(was_near);
  EXPECT_GT((pose_of(s, "ball").position - Vec3(0, 0.02, 0.15)).norm(), 0.05) << "the ball was pushed";
}

TEST(Levels, TraitsOfAMotionAreZeroWhileAnotherWithoutThemMoves) {
  BuiltScenario built = open("handover.yaml");
  Simulation& s = *built.simulation;
  const ObjectId base = s.world().find_robot("guest")->base();
  ASSERT_EQ(s.world().value(base, keys::motion_level), 0u);
  std::set<std::uint32_t> levels;
  for (int k = 0; k < 240; ++k) {
    const std::uint32_t level = s.world().value(base, keys::motion_level);
    levels.insert(level);
    EXPECT_EQ(s.world().value(base, keys::contact_world) != 0, level == 1) << "at " << 0.05 * k;
    s.run_for(0.05);
  }
  EXPECT_EQ(levels.size(), 2u);
}

TEST(Levels, AShadowTellsWhatTheLevelLeavesOut) {
  BuiltScenario built = open("handover.yaml");
  built.simulation->run_for(6);
  const std::vector<ShadowResult> shadows = shadow_results(*built.simulation);
  ASSERT_EQ(shadows.size(), 1u);
  EXPECT_EQ(shadows[0].robot, "scout");
  EXPECT_EQ(shadows[0].motion, "motion.bullet");
  EXPECT_GT(shadows[0].max_distance, 0.001) << "skidding wheels take another way";
  EXPECT_LT(shadows[0].max_distance, 3);
}

}  // namespace
}  // namespace muro::host
