// SPDX-License-Identifier: MIT
// The number of threads, the order of declaration and the way of dividing work change no bit.
#include <gtest/gtest.h>

#include <filesystem>

#include "host/scenario/builder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// Returns all files under examples/ that have robots, except those with a server, whose port may be taken.
std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(MURO_TEST_SOURCE_DIR "/examples"))
    if (const std::string text = entry.path().extension() == ".yaml" ? test::text_of(entry.path()) : "";
        text.find("\nrobots:") != std::string::npos && text.find("stream:") == std::string::npos)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Returns overrides for one camera instead of twenty, whose pictures take minutes without a GPU.
std::vector<std::string> lighter(const std::string& example) {
  if (!example.ends_with("/soccer/cameras.yaml")) return {};
  return {"robots.red.camera=off", "robots.blue[1-9].camera=off"};
}

/// Returns the hash after `seconds` on `threads` threads, all of which are used wherever calls may overlap.
std::uint64_t hash_after(Scenario scenario, double seconds, unsigned threads) {
  BuiltScenario built = build(std::move(scenario), test::plugins());
  built.simulation->set_threads(threads);
  built.simulation->scheduler().executor().set_always_parallel(true);
  built.simulation->run_for(seconds);
  return built.simulation->state_hash();
}

struct OfExample : ::testing::TestWithParam<std::string> {};

TEST_P(OfExample, AnyNumberOfThreadsGivesTheSameBits) {
  const std::vector<unsigned> numbers[] = {{2, 8}, {3}, {4}};  // for each seed
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Scenario scenario = read_scenario(GetParam(), lighter(GetParam()));
    scenario.seed = seed;
    const std::uint64_t alone = hash_after(scenario, 4, 1);
    for (const unsigned threads : numbers[seed - 1])
      EXPECT_EQ(hash_after(scenario, 4, threads), alone) << threads << " threads, seed " << seed;
  }
}
std::string name_of(const ::testing::TestParamInfo<std::string>& example) {
  const std::filesystem::path path(example.param);
  const std::string folder = path.parent_path().stem().string(), name = path.stem().string();
  return folder == name ? name : folder + "_" + name;
}
INSTANTIATE_TEST_SUITE_P(Threads, OfExample,
                         ::testing::Values(MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml",
                                           MURO_TEST_SOURCE_DIR "/examples/levels/handover.yaml"),
                         name_of);
INSTANTIATE_TEST_SUITE_P(SlowThreads, OfExample, ::testing::ValuesIn(examples()), name_of);

/// Some robots of each level, so close together that they touch, with boxes and balls between them.
constexpr const char* crowd[] = {
    "  near:\n    model: {MODELS}/rover.urdf\n    count: 14\n"
    "    place: {grid: {count: [7, 2], spacing: [0.6, 0.6]}}\n"
    "    motion: {use: motion.simplified}\n    drive: {use: drive.skid_steer}\n"
    "    laser: {use: laser.raycast, on: laser_link, rate: 20, rays: 60, max_range: 5}\n"
    "    control: {use: controller.library, library: wander, rate: 20}\n",
    "  boxes:\n    shape: {box: [0.3, 0.3, 0.2]}\n    mass: 2\n    count: 6\n"
    "    place: {grid: {count: [6, 1], spacing: [0.6, 1], center: {y: 1.4, z: 0.4}}}\n"
    "    motion: {use: motion.simplified}\n",
    "  carts:\n    model: {MODELS}/rover.urdf\n    count: 9\n"
    "    place: {grid: {count: [9, 1], spacing: [0.6, 1], center: {y: -1.4}}}\n"
    "    motion: {use: motion.differential_drive}\n    drive: {use: drive.differential}\n"
    "    laser: {use: laser.raycast, on: laser_link, rate: 15, rays: 40, max_range: 5}\n"
    "    control: {use: controller.library, library: wander, rate: 20}\n",
    "  falling:\n    shape: {box: [0.3, 0.3, 0.1]}\n    mass: 1\n    count: 14\n"
    "    place: {grid: {count: [7, 2], spacing: [0.6, 0.6], center: {x: 0.05, z: 0.3}}}\n"
    "    motion: {use: motion.simplified}\n",
    "  walkers:\n    model: {MODELS}/quadruped.urdf\n    count: 5\n"
    "    place: {grid: {count: [5, 1], spacing: [0.55, 1], center: {y: -0.45, z: 0.05}}}\n"
    "    motion: {use: motion.articulated, joints: position}\n"
    "    laser: {use: laser.raycast, on: base_link, rate: 15, rays: 20, max_range: 5}\n",
    "  rollers:\n    model: {MODELS}/rover.urdf\n    count: 5\n"
    "    place: {grid: {count: [5, 1], spacing: [0.6, 1], center: {x: 0.1, y: 0.9, z: 0.02}}}\n"
    "    motion: {use: motion.articulated}\n    drive: {use: drive.skid_steer}\n"
    "    laser: {use: laser.raycast, on: laser_link, rate: 15, rays: 40, max_range: 5}\n"
    "    control: {use: controller.library, library: wander, rate: 20}\n",
};

Scenario crowd_in_order(const test::ScratchFolder& folder, const std::vector<int>& order) {
  std::string text =
      "name: crowd\nworld: {objects: {ground: {shape: plane}, wall: {shape: {box: [8, 0.2, 1]}, at: {y: "
      "2.4}}}}\nrobots:\n";
  for (const int part : order) text += crowd[part];
  for (std::size_t at; (at = text.find("{MODELS}")) != std::string::npos;)
    text.replace(at, 8, MURO_TEST_SOURCE_DIR "/examples/models");
  folder.file("crowd.yaml", text);
  return read_scenario(folder.path("crowd.yaml"), {});
}

TEST(Threads, ACrowdThatCollidesIsTheSameOnAnyNumber) {
  const test::ScratchFolder folder;
  const Scenario scenario = crowd_in_order(folder, {0, 1, 2, 3});
  const std::uint64_t alone = hash_after(scenario, 5, 1);
  for (const unsigned threads : {2u, 3u, 4u, 8u}) EXPECT_EQ(hash_after(scenario, 5, threads), alone) << threads;
}

TEST(Threads, ArticulatedRobotsInACrowdAreTheSameOnAnyNumber) {
  const test::ScratchFolder folder;
  const Scenario scenario = crowd_in_order(folder, {1, 2, 4, 5});
  const std::uint64_t alone = hash_after(scenario, 1.5, 1);
  for (const unsigned threads : {2u, 3u}) EXPECT_EQ(hash_after(scenario, 1.5, threads), alone) << threads;
}

TEST(Threads, ASnapshotOrAResetOfACrowdThatCollidesChangesNoBit) {
  const test::ScratchFolder folder;
  BuiltScenario built = build(crowd_in_order(folder, {1, 2, 4, 5}), test::plugins());
  Simulation& s = *built.simulation;
  s.set_threads(3);
  s.scheduler().executor().set_always_parallel(true);
  s.run_for(0.7531);
  const Snapshot middle = s.snapshot();
  s.run_for(0.5);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.5);
  EXPECT_EQ(s.state_hash(), end);
  s.reset();
  s.run_for(1.2531);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(Threads, TheirNumberMayChangeBetweenRuns) {
  const test::ScratchFolder folder;
  const Scenario scenario = crowd_in_order(folder, {0, 1, 2, 3});
  BuiltScenario built = build(Scenario(scenario), test::plugins());
  built.simulation->scheduler().executor().set_always_parallel(true);
  for (const unsigned threads : {8u, 2u, 1u, 3u, 8u}) {
    built.simulation->set_threads(threads);
    built.simulation->run_for(0.4);
  }
  EXPECT_EQ(built.simulation->state_hash(), hash_after(scenario, 2, 1));
}

TEST(SlowThreads, TheOrderOfDeclarationChangesNoRobot) {
  const test::ScratchFolder folder;
  std::map<std::string, std::uint64_t> first;
  for (const std::vector<int>& order : {std::vector<int>{0, 1, 2, 3, 4, 5}, {2, 5, 0, 3, 4, 1}, {3, 1, 4, 2, 5, 0}}) {
    BuiltScenario built = build(crowd_in_order(folder, order), test::plugins());
    built.simulation->set_threads(2);
    built.simulation->run_for(10);
    for (const RobotView* r : built.simulation->world().robots()) {
      const std::uint64_t hash = built.simulation->world().hash(*r);
      const auto [known, fresh] = first.emplace(r->name, hash);
      EXPECT_EQ(known->second, hash) << r->name;
    }
  }
  EXPECT_EQ(first.size(), 53u);
}

TEST(Threads, AlgorithmsTouchOnlyWhatTheyHaveDeclared) {
  const test::ScratchFolder folder;
  const std::pair<std::vector<int>, double> crowds[] = {{{0, 1, 2, 3}, 0.5}, {{1, 4, 5}, 0.2}};
  for (const auto& [parts, seconds] : crowds) {  // many robots touch in that time
    BuiltScenario plain = build(crowd_in_order(folder, parts), test::plugins());
    BuiltScenario checked = build(crowd_in_order(folder, parts), test::plugins());
    checked.simulation->verify_access();
    plain.simulation->run_for(seconds);
    checked.simulation->run_for(seconds);
    EXPECT_EQ(plain.simulation->state_hash(), checked.simulation->state_hash());
  }
}

}  // namespace
}  // namespace muro::host
