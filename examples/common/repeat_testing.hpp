// SPDX-License-Identifier: MIT
// Equal bits on any number of threads, from a snapshot and after a reset, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "host/scenario/builder.hpp"
#include "tests/support/scene.hpp"

namespace muro::example_test {

/// Returns the hash of the state of a scenario after `seconds` on this number of threads.
inline std::uint64_t hash_on(unsigned threads, const std::string& file, const std::vector<std::string>& overrides,
                             double seconds) {
  host::BuiltScenario built = host::build(host::read_scenario(file, overrides), test::plugins());
  built.simulation->set_threads(threads);
  built.simulation->run_for(seconds);
  return built.simulation->state_hash();
}

/// Takes a snapshot after `before` s and runs for `after` s, twice. Expects the same bits, and returns their hash.
inline std::uint64_t expect_same_bits_from_snapshot(Simulation& s, double before, double after) {
  s.run_for(before);
  const Snapshot middle = s.snapshot();
  s.run_for(after);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(after);
  EXPECT_EQ(s.state_hash(), end);
  return end;
}

}  // namespace muro::example_test
