// SPDX-License-Identifier: MIT
// Equal bits on any number of threads, from a snapshot and after a reset.
#include <gtest/gtest.h>

#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

TEST(Repeat, ThreadsDoNotMatter) {
  const auto hash = [](unsigned threads) {
    host::BuiltScenario built = host::build(host::read_scenario(scenario, {}), test::plugins());
    built.simulation->set_threads(threads);
    built.simulation->run_for(4);
    return built.simulation->state_hash();
  };
  EXPECT_EQ(hash(1), hash(3));
}

TEST(Repeat, ASnapshotAndAResetGoOnAlike) {
  Walker walker;
  Simulation& s = walker.simulation();
  walker.run(4);
  const Snapshot middle = s.snapshot();
  walker.run(1);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  walker.run(1);
  EXPECT_EQ(s.state_hash(), end);
  s.reset();
  walker.run(5);
  EXPECT_EQ(s.state_hash(), end);
}

}  // namespace
}  // namespace muro::walk_test
