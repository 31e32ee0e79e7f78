// SPDX-License-Identifier: MIT
// Runs with known results.
#include "host/tools/compare/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// A ball of 0.1 m that flies without gravity at 1 m/s between walls 0.6 m and -0.6 m away, and bounces without loss.
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
  std::vector<std::string> said;
  Runs(const std::string& text, const std::string& vary, const std::map<std::string, std::string>& models = {}) {
    for (const auto& [name, model] : models) folder.file(name, model);
    comparison.scenario.file = folder.file("s.yaml", text);
    comparison.scenario = read_variation(comparison, {}, test::plugins());
    comparison.factors = {read_factor(vary, comparison.scenario, test::plugins())};
    comparison.duration = comparison.scenario.duration;
    comparison.robots = robots_of(comparison.scenario, comparison.factors);
  }
  std::vector<VariationResult> all() {
    std::vector<VariationResult> results;
    for (const Variation& v : all_variations(comparison.factors))
      results.push_back(run_variation(comparison, v, test::plugins(),
                                      [&](LogLevel, std::string_view text) { said.emplace_back(text); }));
    return results;
  }
};

TEST(Comparison, ContactsBeginWhenGeometrySaysSo) {
  const std::vector<VariationResult> results = Runs(billiard, "ball.motion=simplified").all();
  ASSERT_EQ(results[0].failure, "");
  // 0.5 m to the first wall, then 1 m from wall to wall: at 0.5, 1.5 and 2.5 s
  ASSERT_TRUE(results[0].contacts);
  EXPECT_EQ(*results[0].contacts, 3u);
  EXPECT_NEAR(results[0].first_contact.value_or(0), 0.5, 0.011);
  EXPECT_NEAR(results[0].trajectory->distance(), 3, 0.15) << "sampled ten times a second";
  EXPECT_TRUE(results[0].repeatable);
}

TEST(Comparison, AllEnginesTouchAtTheSameTime) {
  std::string motions;
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.features.value_or(0) & feature_contact) motions += (motions.empty() ? "" : ",") + o.id;
  for (const VariationResult& l : Runs(billiard, "ball.motion=" + motions).all()) {
    ASSERT_EQ(l.failure, "") << l.label;
    EXPECT_GE(l.contacts.value_or(0), 1u) << l.label;
    EXPECT_NEAR(l.first_contact.value_or(0), 0.5, 0.011) << l.label;
  }
}

TEST(Comparison, ARobotThatNoForceMovesHasNoContacts) {
  const std::vector<VariationResult> results = Runs(billiard, "ball.motion=point").all();
  ASSERT_EQ(results[0].failure, "");
  EXPECT_FALSE(results[0].contacts);
  EXPECT_FALSE(results[0].first_contact);
  ASSERT_EQ(results[0].unsupported.size(), 1u);
  EXPECT_EQ(results[0].unsupported[0].motion, "motion.point");
}

TEST(Comparison, GroundDoesNotCount) {
  const std::vector<VariationResult> results = Runs(R"(
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
  ASSERT_EQ(results[0].failure, "");
  EXPECT_EQ(results[0].contacts.value_or(99), 0u)
      << "one stands on the plane, one on a table from the start, one falls on the plane";
}

TEST(Comparison, AVariationThatCannotRunSaysWhy) {
  std::string limited = billiard;
  limited.replace(limited.find("rate: 2000"), 10, "max_joint_acceleration: 5");
  const std::vector<VariationResult> results = Runs(limited, "ball.motion=point,simplified").all();
  EXPECT_NE(results[0].failure.find("`max_joint_acceleration`"), std::string::npos) << results[0].failure;
  EXPECT_EQ(results[1].failure, "");
}

TEST(Comparison, RobotsMayCollideWithMeshes) {
  const std::string scenario =
      "duration: 0.3\nworld: {objects: {ground: {shape: plane}}}\nrobots:\n  tool: {model: " MURO_TEST_SOURCE_DIR
      "/tests/robots/meshes.urdf, at: {z: 2}, motion: {use: motion.simplified}}\n";
  for (const VariationResult& r : Runs(scenario, "tool.motion=simplified,bullet,ode,mujoco").all())
    EXPECT_EQ(r.failure, "") << r.label;
}

TEST(Comparison, AFixedArmDeviatesByItsJointsAndLinks) {
  constexpr double start = 0.1, length = 1, spin = 1e-3;  // rad, m, kg m^2 of a ball of 1 kg
  Runs runs(R"(
duration: 3
robots:
  pendulum: {model: p.urdf, at: {z: 2}, joints: {hinge: 0.1}, motion: {use: motion.point, motion.articulated: {base: fixed, passive_joints: [hinge]}}}
)",
            "pendulum.motion=point,articulated", {{"p.urdf", R"(<robot name="p"><link name="base"/>
  <link name="rod"><inertial><origin xyz="0 0 -1"/><mass value="1"/>
    <inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial></link>
  <link name="tip"/>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
  <joint name="end" type="fixed"><parent link="rod"/><child link="tip"/><origin xyz="0 0 -1"/></joint>
</robot>)"}});
  const std::vector<VariationResult> results = runs.all();
  ASSERT_EQ(results[0].failure + results[1].failure, "");
  const Deviation d = deviation_of(*results[0].trajectory, *results[1].trajectory);
  EXPECT_EQ(d.position_largest, 0) << "the base is fixed";
  ASSERT_TRUE(d.revolute_joints && d.links && !d.prismatic_joints);
  // without forces the joint stays; with forces it swings as a pendulum
  const double frequency = std::sqrt(9.81 * length / (length * length + spin));
  double angles = 0, ways = 0, largest = 0;
  for (int i = 0; i <= 30; ++i) {
    const double angle = start * (1 - std::cos(frequency * 0.1 * i)), way = 2 * length * std::sin(angle / 2);
    angles += angle * angle / 31;
    ways += way * way / 62;  // the rod's own origin is in the hinge
    largest = std::max(largest, angle);
  }
  EXPECT_NEAR(d.revolute_joints->rms, std::sqrt(angles), 0.005 * start);
  EXPECT_NEAR(d.revolute_joints->largest, largest, 0.005 * start);
  EXPECT_NEAR(d.links->rms, std::sqrt(ways), 0.005 * start);
  EXPECT_NEAR(d.links->largest, 2 * length * std::sin(largest / 2), 0.005 * start);
}

TEST(Comparison, RecordersStayOut) {
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
