// SPDX-License-Identifier: MIT
// Pushes that the humanoid withstands while it walks.
#include <gtest/gtest.h>

#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

/// Returns whether it withstands four pushes of 0.1 s, N s ahead and to the left, each at another phase of a step.
bool bears(double ahead, double left, const std::string& numbers) {
  Walker walker({tunables(numbers)});
  walker.run(5);
  for (int k = 0; k < 4; ++k) {
    walker.push(Vec3(ahead, left, 0) / 0.1);
    walker.run(0.104);
    walker.push(Vec3::Zero());
    walker.run(1.976);
  }
  return walker.least_upright() > 0.8;
}

TEST(Push, IsBorneFromAllSides) {
  for (const auto& [ahead, left] : {std::pair{0.5, 0.0}, {-0.5, 0.0}, {0.0, 0.4}, {0.0, -0.4}})
    EXPECT_TRUE(bears(ahead, left, "forward=0.1")) << ahead << " " << left;
}

TEST(Push, NeedsTheGyroscope) {
  const char* without =
      "forward=0.1, ankle_pitch_rate=0, ankle_roll_rate=0, ankle_pitch_tilt=0, ankle_roll_tilt=0, capture=0";
  EXPECT_FALSE(bears(-0.7, 0, without) && bears(0, 0.6, without));
}

}  // namespace
}  // namespace muro::walk_test
