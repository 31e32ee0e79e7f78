// SPDX-License-Identifier: MIT
// Plugins must keep what they promise: determinism, independent items, no allocation, restorable state.
#include <gtest/gtest.h>

#include "tests/conformance/team.hpp"
#include "tests/support/allocation_counter.hpp"

namespace muro {
namespace {

class EveryMotionsTeam : public ::testing::TestWithParam<std::string> {};
class EveryAllocationFreeMotionsTeam : public EveryMotionsTeam {};

TEST_P(EveryMotionsTeam, GivesTheSameBitsTwice) {
  test::Team a(GetParam()), b(GetParam());
  a.run_for(2);
  b.run_for(2);
  EXPECT_EQ(a.state_hash(), b.state_hash());
}

TEST_P(EveryMotionsTeam, GoesOnFromASnapshotToTheSameBits) {
  test::Team team(GetParam());
  team.run_for(1.0371);
  const Snapshot snapshot = team.snapshot();
  team.run_for(1);
  const std::uint64_t end = team.state_hash();
  team.restore(snapshot);
  team.run_for(1);
  EXPECT_EQ(team.state_hash(), end);
}

TEST_P(EveryMotionsTeam, IsFreshAfterAReset) {
  test::Team team(GetParam());
  const std::uint64_t start = team.state_hash();
  team.run_for(1);
  team.reset();
  team.command();
  EXPECT_EQ(team.state_hash(), start);
}

TEST_P(EveryAllocationFreeMotionsTeam, AllocatesNothingInAStepOnceWarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  ASSERT_EQ(test::allocations(), 0u) << "sanitizers count allocations themselves";
#else
  test::Team team(GetParam());
  const std::uint64_t before_build = test::allocations();
  { const std::vector<int> shows_that_counting_works(100); }
  ASSERT_GT(test::allocations(), before_build);
  team.run_for(8);
  const std::uint64_t before = test::allocations();
  team.run_for(3);
  EXPECT_EQ(test::allocations() - before, 0u);
#endif
}

/// Returns the motions that promise to be free of allocations; engines may allocate.
std::vector<std::string> allocation_free_motions() {
  std::vector<std::string> some = test::algorithms_of("motion");
  std::erase_if(some, [](const std::string& id) {
    return (test::plugins().algorithm(id).description->capabilities & Capability::allocation_free) == 0;
  });
  return some;
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryMotionsTeam, ::testing::ValuesIn(test::algorithms_of("motion")),
                         test::name_of);
INSTANTIATE_TEST_SUITE_P(Conformance, EveryAllocationFreeMotionsTeam, ::testing::ValuesIn(allocation_free_motions()),
                         test::name_of);

/// Runs one step of every batched algorithm with all items at once and one by one, from the same state.
void expect_same_bits_item_by_item(const std::string& motion) {
  test::Team whole(motion), split(motion);
  whole.run_for(0.5);
  split.run_for(0.5);
  ASSERT_EQ(whole.state_hash(), split.state_hash());
  abi::ErrorText error;
  std::set<std::string> tried;
  for (std::size_t i = 0; i < whole.instances().size(); ++i) {
    Instance& a = *whole.instances()[i];
    Instance& b = *split.instances()[i];
    if ((a.description().capabilities & Capability::batched) == 0) continue;
    tried.insert(a.setup().use);
    const auto items = std::uint32_t(a.setup().items.size());
    const std::vector<Phase> phases = a.phases();
    for (std::uint32_t phase = 0; phase < phases.size(); ++phase) {
      if (phases[phase].index_space != Phase::IndexSpace::items) continue;
      Step step{whole.now(), 0.001, 500, 1};
      step.phase = phase;
      ASSERT_TRUE(a.algorithm().step(step, {0, items}, error)) << error.view();
      for (std::uint32_t k = items; k-- > 0;) ASSERT_TRUE(b.algorithm().step(step, {k, k + 1}, error)) << error.view();
    }
    EXPECT_EQ(whole.state_hash(), split.state_hash()) << a.setup().use;
  }
  for (const std::string& id : {motion, std::string("kinematics.direct"), std::string("laser.raycast"),
                                std::string("sensor.error"), std::string("drive.skid_steer")})
    EXPECT_EQ(tried.count(id), 1u) << id << " is batched";
}

TEST(BatchedAlgorithms, GiveTheSameBitsItemByItemAsInOnePiece) {
  for (const char* motion : {"motion.simplified", "motion.articulated"}) expect_same_bits_item_by_item(motion);
}

}  // namespace
}  // namespace muro
