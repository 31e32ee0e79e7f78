// SPDX-License-Identifier: MIT
// Several worlds in one process, one after the other and at the same time, do not influence each other.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <thread>

#include "host/outputs/report.hpp"
#include "host/scenario/builder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

constexpr double duration = 0.3;  // s

/// Returns all scenarios of the examples, except those with a server, whose port only one can have, and scenarios of
/// robots with collision meshes in every motion by forces.
std::vector<Scenario> scenarios(const test::ScratchFolder& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(MURO_TEST_SOURCE_DIR "/examples"))
    if (const std::string text = entry.path().extension() == ".yaml" ? test::text_of(entry.path()) : "";
        text.find("\nrobots:") != std::string::npos && text.find("stream:") == std::string::npos)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const char* motion : {"simplified", "articulated", "bullet", "ode", "mujoco"})
    files.push_back(folder.file(
        std::string(motion) + ".yaml",
        std::string("world: {objects: {ground: {shape: plane}}}\nrobots:\n  tool: {model: " MURO_TEST_SOURCE_DIR
                    "/tests/robots/meshes.urdf, count: 2, place: {grid: "
                    "{count: [2, 1], spacing: [4, 4], center: {z: 2}}}, motion: {use: motion.") +
            motion + "}}\n"));
  std::vector<Scenario> all;
  for (const std::string& file : files) all.push_back(read_scenario(file, {}));
  return all;
}

/// Returns the state hash at the end, or nothing if an algorithm takes decisions by computing time.
std::optional<std::uint64_t> hash_of(const Scenario& scenario, Registry& registry) {
  const BuiltScenario built =
      build(Scenario(scenario), registry, [](Simulation& s) { s.set_log([](LogLevel, std::string_view) {}); });
  built.simulation->run_for(duration);
  if (!nondeterministic_algorithms(*built.simulation).empty()) return std::nullopt;
  return built.simulation->state_hash();
}

/// Results of each scenario when it is the only one in the process.
struct Worlds : ::testing::Test {
  static std::vector<Scenario> all;
  static std::vector<std::optional<std::uint64_t>> alone;
  static void SetUpTestSuite() {
    const test::ScratchFolder folder;
    all = scenarios(folder);
    for (const Scenario& s : all) alone.push_back(hash_of(s, test::plugins()));
  }
};
std::vector<Scenario> Worlds::all;
std::vector<std::optional<std::uint64_t>> Worlds::alone;

using SlowWorlds = Worlds;

TEST_F(SlowWorlds, OneAfterTheOtherAreAsAlone) {
  for (std::size_t i = all.size(); i-- > 0;) EXPECT_EQ(hash_of(all[i], test::plugins()), alone[i]) << all[i].file;
}

TEST_F(Worlds, AtOnceAreAsAlone) {
  // from both ends, so that different scenarios run at the same time
  const auto run = [&](bool backwards) {
    Registry registry({MURO_TEST_PLUGIN_DIR});
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::size_t i = backwards ? all.size() - 1 - k : k;
      EXPECT_EQ(hash_of(all[i], registry), alone[i]) << all[i].file;
    }
  };
  std::thread other(run, true);
  run(false);
  other.join();
}

}  // namespace
}  // namespace muro::host
