// SPDX-License-Identifier: MIT
// Runs of which one knows what must come out.
#include "host/compare/level.hpp"

#include <gtest/gtest.h>

#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// Without gravity a ball of 0.1 m flies at 1 m/s between walls 0.6 m and -0.6 m away, and comes back as fast.
constexpr const char* billiard = R"(
duration: 3
world:
  gravity: [0, 0, 0]
  objects:
    right: {shape: {box: [0.2, 4, 4]}, restitution: 1, at: {x: 0.7, z: 0}}
    left: {shape: {box: [0.2, 4, 4]}, restitution: 1, at: {x: -0.7, z: 0}}
robots:
  ball:
    shape: {sphere: 0.1}
    mass: 1
    friction: 0
    at: {z: 0}
    velocity: [1, 0, 0]
    motion: {use: motion.simplified, rate: 2000}
)";

struct Runs {
  test::ScratchFolder folder;
  Comparison comparison;
  explicit Runs(const std::string& text, const std::string& vary) {
    comparison.scenario.file = folder.file("s.yaml", text);
    comparison.scenario = read_level(comparison, {}, test::plugins());
    comparison.varieties = {read_vary(vary, comparison.scenario, test::plugins())};
    comparison.duration = comparison.scenario.duration;
    comparison.robots = robots_of(comparison.scenario, comparison.varieties);
  }
  std::vector<Level> all() {
    std::vector<Level> levels;
    for (const Variation& v : product(comparison.varieties))
      levels.push_back(run_level(comparison, v, test::plugins()));
    return levels;
  }
};

TEST(Level, ContactsBeginWhenGeometrySaysSo) {
  const std::vector<Level> levels = Runs(billiard, "ball.motion=simplified").all();
  ASSERT_EQ(levels[0].failure, "");
  // 0.5 m to the first wall, then 1 m each: at 0.5, 1.5 and 2.5 s
  ASSERT_TRUE(levels[0].contacts);
  EXPECT_EQ(*levels[0].contacts, 3u);
  EXPECT_NEAR(levels[0].first_contact.value_or(0), 0.5, 0.011);
  EXPECT_NEAR(levels[0].track->distance(), 3, 0.15) << "looked at ten times a second, it cuts the turns";
  EXPECT_TRUE(levels[0].repeatable);
}

TEST(Level, AllEnginesTouchAtTheSameTime) {
  std::string motions;
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.features.value_or(0) & feature_contact) motions += (motions.empty() ? "" : ",") + o.id;
  for (const Level& l : Runs(billiard, "ball.motion=" + motions).all()) {
    ASSERT_EQ(l.failure, "") << l.label;
    EXPECT_GE(l.contacts.value_or(0), 1u) << l.label;
    EXPECT_NEAR(l.first_contact.value_or(0), 0.5, 0.011) << l.label;
  }
}

TEST(Level, ARobotThatNoForceMovesHasNoContactsAndStaysWhereCommandsLeaveIt) {
  const std::vector<Level> levels = Runs(billiard, "ball.motion=point").all();
  ASSERT_EQ(levels[0].failure, "");
  EXPECT_FALSE(levels[0].contacts);
  EXPECT_FALSE(levels[0].first_contact);
  ASSERT_EQ(levels[0].losses.size(), 1u);
  EXPECT_EQ(levels[0].losses[0].motion, "motion.point");
}

TEST(Level, GroundDoesNotCount) {
  const std::vector<Level> levels = Runs(R"(
duration: 0.5
world: {objects: {ground: {shape: plane}, table: {shape: {box: [1, 1, 0.5]}, at: {x: 3}}}}
robots:
  boxes:
    shape: {box: [0.2, 0.2, 0.2]}
    mass: 1
    place: {list: [{x: 0}, {x: 3, z: 0.6}, {x: -3, z: 0.15}]}
    motion: {use: motion.simplified}
)",
                                         "boxes.motion=simplified")
                                        .all();
  ASSERT_EQ(levels[0].failure, "");
  EXPECT_EQ(levels[0].contacts.value_or(99), 0u)
      << "one stands on the plane, one on a table from the start, one falls on the plane";
}

TEST(Level, ALevelThatCannotRunSaysWhy) {
  std::string limited = billiard;
  limited.replace(limited.find("rate: 2000"), 10, "max_joint_acceleration: 5");
  const std::vector<Level> levels = Runs(limited, "ball.motion=point,simplified").all();
  EXPECT_NE(levels[0].failure.find("`max_joint_acceleration`"), std::string::npos) << levels[0].failure;
  EXPECT_EQ(levels[1].failure, "");
}

TEST(Level, RecordersStayOut) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("log.csv");
  std::string recorded = billiard;
  recorded +=
      "algorithms: {log: {use: recorder.csv, rate: 10, properties: [\"ball/body:pose\"], file: " + file + "}}\n";
  recorded += "schedule: {sequences: [[ball.motion, log]]}\n";
  Runs runs(recorded, "ball.motion=simplified");
  EXPECT_EQ(runs.all()[0].failure, "");
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace muro::host
