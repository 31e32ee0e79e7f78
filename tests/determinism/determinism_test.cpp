// SPDX-License-Identifier: MIT
// Equal input and seed give equal bits: the urban team at several levels and with noisy sensors.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::vector<std::string> mixed = {
    "robots.rovers.count=12",
    "robots.rovers[0-2].motion.use=motion.differential_drive",
    "robots.rovers[3-4].motion.use=motion.point",
    "robots.rovers.noise={use: sensor.error, on: laser, sigma: 0.005, correlation: 0.5, resolution: 0.001, dropout: "
    "0.01}",
};

BuiltScenario open(std::uint64_t seed = 1, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = mixed;
  overrides.insert(overrides.end(), more.begin(), more.end());
  Scenario s = read_scenario(MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml", overrides);
  s.seed = seed;
  return build(std::move(s), test::plugins());
}

TEST(Determinism, TwoRunsAreEqualAndAnotherSeedIsNot) {
  std::vector<std::uint64_t> hashes;
  for (const std::uint64_t seed : {1u, 1u, 2u}) {
    BuiltScenario b = open(seed);
    b.simulation->run_for(5);
    hashes.push_back(b.simulation->state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_NE(hashes[0], hashes[2]);
}

TEST(Determinism, RunResetRunGivesEqualHashesAllTheWay) {
  BuiltScenario b = open();
  Simulation& s = *b.simulation;
  std::vector<std::uint64_t> first, second;
  const std::uint64_t fresh = s.state_hash();
  for (int i = 0; i < 10; ++i) {
    s.run_for(0.37);
    first.push_back(s.state_hash());
  }
  s.reset();
  EXPECT_EQ(s.state_hash(), fresh);
  for (int i = 0; i < 10; ++i) {
    s.run_for(0.37);
    second.push_back(s.state_hash());
  }
  EXPECT_EQ(first, second);
}

TEST(Determinism, ASnapshotRestoredMidRunGoesOnBitEqual) {
  BuiltScenario b = open();
  Simulation& s = *b.simulation;
  s.run_for(2.0533);  // between two scans, so that held readings matter
  const Snapshot middle = s.snapshot();
  const std::uint64_t at_middle = s.state_hash();
  s.run_for(3);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  EXPECT_EQ(s.state_hash(), at_middle);
  s.run_for(3);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(Determinism, ASnapshotContinuesBitEqualInAnotherSimulation) {
  BuiltScenario a = open(), b = open();
  a.simulation->run_for(2.0533);
  b.simulation->run_for(0.5);
  b.simulation->restore(a.simulation->snapshot());
  a.simulation->run_for(1);
  b.simulation->run_for(1);
  EXPECT_EQ(a.simulation->state_hash(), b.simulation->state_hash());
}

TEST(Determinism, WatchingChangesNothing) {
  const test::ScratchFolder folder;
  BuiltScenario alone = open();
  BuiltScenario watched = open(1, {"algorithms.log={use: recorder.csv, rate: 37, file: " + folder.path("log.csv") +
                                   ", properties: ['rovers_*/*:pose', 'rovers_*/laser:ranges*']}"});
  alone.simulation->run_for(3);
  watched.simulation->run_for(3);
  watched.simulation->finish();
  EXPECT_EQ(alone.simulation->state_hash(), watched.simulation->state_hash());
  EXPECT_GT(test::text_of(folder.path("log.csv")).size(), 100'000u) << "it really watches";
}

TEST(Determinism, RefreshingPosesBetweenInstantsChangesNothing) {
  BuiltScenario a = open(), b = open();
  a.simulation->run_for(2);
  for (int i = 0; i < 20; ++i) {
    b.simulation->run_for(0.1);
    b.simulation->refresh();
    const World& w = b.simulation->world();
    const Pose& base = w.value("rovers_7/base_link", keys::pose);
    const Pose& laser = w.value("rovers_7/laser_link", keys::pose);
    EXPECT_NEAR((laser.position - base.position).dot(base.orientation * Vec3::UnitZ()), 0.03, 1e-12);
  }
  EXPECT_EQ(a.simulation->state_hash(), b.simulation->state_hash());
}

TEST(Determinism, StoppingBetweenInstantsChangesNothing) {
  BuiltScenario a = open(), b = open();
  a.simulation->run_for(1);
  for (int i = 0; i < 1000; ++i) b.simulation->run_until((i + 1) * 1'000'000);
  EXPECT_EQ(a.simulation->state_hash(), b.simulation->state_hash());
}

}  // namespace
}  // namespace muro::host
