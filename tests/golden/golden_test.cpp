// SPDX-License-Identifier: MIT
// The examples give the results that examples.hashes says, bit for bit: a change that is meant to change no result
// changes none. One that is meant to replaces the file by what the test prints, and says why.
//
// The file is right for x86-64 processors with FMA: those without get other sines and exponentials from glibc. What is
// drawn (cameras, lasers by the z-buffer) is left out, since it depends on the driver.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "host/scenario/builder.hpp"
#include "tests/golden/property_hashes.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

struct GoldenExample {
  std::string scenario;  ///< path in the source tree
  double duration = 0;   ///< s
  std::map<std::string, std::string> hashes;
};

/// A line "SCENARIO DURATION" begins an example; those that follow it are "KEY CLASS HASH".
std::vector<GoldenExample> golden_examples() {
  std::vector<GoldenExample> examples;
  std::ifstream file(MURO_TEST_SOURCE_DIR "/tests/golden/examples.hashes");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first.empty() || first[0] == '#') continue;
    if (third.empty())
      examples.push_back({first, std::stod(second), {}});
    else
      examples.back().hashes[first] = second + " " + third;
  }
  return examples;
}

bool is_drawn(const std::string& key) {
  return key.starts_with("camera.") || key.starts_with("ranges") || key.starts_with("laser.");
}

struct Golden : ::testing::TestWithParam<GoldenExample> {};

TEST_P(Golden, EveryPropertyOfTheExampleHasItsHash) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "the hashes are those of processors with FMA";
#else
  GTEST_SKIP() << "the hashes are those of x86-64 processors";
#endif
  const GoldenExample& golden = GetParam();
  host::BuiltScenario built =
      host::build(host::read_scenario(std::string(MURO_TEST_SOURCE_DIR "/") + golden.scenario, {}), test::plugins());
  built.simulation->run_until(std::llround(golden.duration * 1e9));
  built.simulation->finish();
  auto seen = test::hashes_by_key(test::property_hashes(built.simulation->world()));
  if (golden.scenario.find("sensors") != std::string::npos)
    std::erase_if(seen, [](const auto& entry) { return is_drawn(entry.first); });
  std::string lines;
  for (const auto& [key, hash] : seen) lines += key + " " + hash + "\n";
  for (const auto& [key, hash] : golden.hashes) {
    ASSERT_TRUE(seen.contains(key)) << "there is no property `" << key << "` any more; there are now:\n" << lines;
    EXPECT_EQ(seen[key], hash) << key;
  }
  EXPECT_EQ(seen.size(), golden.hashes.size()) << "there are now:\n" << lines;
}

INSTANTIATE_TEST_SUITE_P(Examples, Golden, ::testing::ValuesIn(golden_examples()), [](const auto& example) {
  const std::string& path = example.param.scenario;
  const std::size_t begin = path.rfind('/') + 1;
  return path.substr(begin, path.rfind('.') - begin);
});

}  // namespace
}  // namespace muro
