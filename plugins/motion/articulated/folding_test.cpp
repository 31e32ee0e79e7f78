// SPDX-License-Identifier: MIT
#include "folding.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace muro::articulated {
namespace {

/// Returns a base with two arms of two bodies, 1 2 and 3 4, and a head 5.
std::vector<Body> torso() {
  std::vector<Body> bodies(6);
  const int parents[] = {-1, 0, 1, 0, 3, 0};
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].parent = parents[i];
  bodies[1].kept = bodies[3].kept = true;
  return bodies;
}
std::vector<Folding> planned(const std::vector<int>& changed) {
  const std::vector<Body> bodies = torso();
  bool flags[6] = {};
  for (const int k : changed) flags[k] = true;
  std::vector<Folding> plan(bodies.size());
  plan_folding({.bodies = bodies.data(), .count = int(bodies.size())}, flags, plan.data());
  return plan;
}

constexpr Folding whole = Folding::whole, kept = Folding::kept, none = Folding::none;

TEST(Folding, GoesFromWhatHasChangedToTheBase) {
  EXPECT_EQ(planned({4}), (std::vector{whole, kept, none, whole, whole, whole}));
  EXPECT_EQ(planned({2, 4}), (std::vector{whole, whole, whole, whole, whole, whole}));
}

TEST(Folding, TakesInWhatHangsOnItAndWasNotKept) {
  EXPECT_EQ(planned({3}), (std::vector{whole, kept, none, whole, whole, whole}));
  EXPECT_EQ(planned({0}), (std::vector{whole, kept, none, kept, none, whole}));
}

}  // namespace
}  // namespace muro::articulated
