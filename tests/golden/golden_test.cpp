// SPDX-License-Identifier: MIT
// Runs give exactly the hashes in the files. A change that is not meant to change results must not change them. A
// change that is meant to change results writes the files anew (record.sh), and gives the reason.
//
// every_machine.hashes has scenes in which muro computes everything: every machine gives these hashes, with any
// instruction set and any C library. examples.hashes has examples with engines, whose sines and exponentials are those
// of glibc for x86-64 processors with FMA. Drawn pictures (cameras, lasers by the z-buffer) are left out, since they
// depend on the driver.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/scenario/builder.hpp"
#include "muro/simd/isa.hpp"
#include "tests/golden/property_hashes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using Hashes = std::map<std::string, std::string>;

struct GoldenRun {
  std::string scenario;  ///< path in the source tree
  double duration = 0;   ///< s
  Hashes hashes;

  std::string path() const { return std::string(MURO_TEST_SOURCE_DIR "/") + scenario; }
};

/// Returns the runs of a file. A line "SCENARIO DURATION" begins a run; lines "KEY CLASS HASH" follow it.
std::vector<GoldenRun> golden_runs(const std::string& hashes) {
  std::vector<GoldenRun> runs;
  std::ifstream file(MURO_TEST_SOURCE_DIR "/tests/golden/" + hashes);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first.empty() || first[0] == '#') continue;
    if (third.empty())
      runs.push_back({first, std::stod(second), {}});
    else
      runs.back().hashes[first] = second + " " + third;
  }
  return runs;
}

std::string name_of(const ::testing::TestParamInfo<GoldenRun>& run) {
  const std::string& path = run.param.scenario;
  const std::size_t begin = path.rfind('/') + 1;
  return path.substr(begin, path.rfind('.') - begin);
}

bool is_drawn(const std::string& key) {
  return key.starts_with("camera.") || key.starts_with("ranges") || key.starts_with("laser.");
}

void expect_hashes(const GoldenRun& golden, Hashes seen) {
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

void expect_hashes_here(const GoldenRun& golden) {
  setenv("MURO_CONTROLLER_PATH", MURO_TEST_CONTROLLERS, 1);
  host::BuiltScenario built = host::build(host::read_scenario(golden.path(), {}), test::plugins());
  built.simulation->run_until(std::llround(golden.duration * 1e9));
  built.simulation->finish();
  expect_hashes(golden, test::hashes_by_key(test::property_hashes(built.simulation->world())));
}

/// Runs in a process of its own with the environment variables `variables`.
void expect_hashes_with(const std::string& variables, const GoldenRun& golden) {
  SCOPED_TRACE(variables);
  const test::ScratchFolder folder;
  const std::string out = folder.path("hashes.json");
  const auto run =
      test::run_command(variables +
                        " MURO_CONTROLLER_PATH=" MURO_TEST_CONTROLLERS " MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR
                        " " MURO_PROPERTY_HASHES " " +
                        golden.path() + " --by-key --duration " + std::to_string(golden.duration) + " --out " + out);
  ASSERT_EQ(run.exit_code, 0) << run.output;
  expect_hashes(golden, nlohmann::json::parse(test::text_of(out)).get<Hashes>());
}

struct EveryMachine : ::testing::TestWithParam<GoldenRun> {};

TEST_P(EveryMachine, MeetsTheHashes) { expect_hashes_here(GetParam()); }

#if defined(__x86_64__)
TEST_P(EveryMachine, MeetsTheHashesWithoutFmaAndAvx) {
  expect_hashes_with("GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4 MURO_ISA=base", GetParam());
}

TEST_P(EveryMachine, MeetsTheHashesWithPacksOfAvx2) {
  if (lane::best_isa() < lane::Isa::avx512) GTEST_SKIP() << "this processor runs nothing wider in any case";
  expect_hashes_with("MURO_ISA=avx2", GetParam());
}

/// Checks the effect of GLIBC_TUNABLES, which the test above needs.
TEST(CLibrary, HasOtherElementaryFunctionsWithoutFma) {
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this processor has no other ones";
  const auto with = test::run_command(MURO_PROPERTY_HASHES " --c-library"),
             without = test::run_command("GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4 " MURO_PROPERTY_HASHES
                                         " --c-library");
  ASSERT_EQ(with.exit_code, 0) << with.output;
  EXPECT_NE(with.output, without.output);
}
#endif

INSTANTIATE_TEST_SUITE_P(Golden, EveryMachine, ::testing::ValuesIn(golden_runs("every_machine.hashes")), name_of);

struct Examples : ::testing::TestWithParam<GoldenRun> {};

TEST_P(Examples, WithEnginesMeetTheHashes) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "the hashes are those of processors with FMA";
#else
  GTEST_SKIP() << "the hashes are those of x86-64 processors";
#endif
  expect_hashes_here(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Golden, Examples, ::testing::ValuesIn(golden_runs("examples.hashes")), name_of);

}  // namespace
}  // namespace muro
