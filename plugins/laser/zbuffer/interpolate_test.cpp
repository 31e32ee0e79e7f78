// SPDX-License-Identifier: MIT
#include "interpolate.hpp"

#include <gtest/gtest.h>

namespace muro::zbuffer {
namespace {

/// As one number, and as eight at once.
float between(float a, float b, float c, float d, float f) {
  const auto eight = [](float x) { return Eight{x, x, x, x, x, x, x, x}; };
  const float one = zbuffer::between<float>(a, b, c, d, f);
  const Eight all = zbuffer::between<Eight>(eight(a), eight(b), eight(c), eight(d), eight(f));
  for (int k = 0; k < 8; ++k) EXPECT_EQ(all[k], one);
  return one;
}

TEST(BetweenPixels, APlaneIsReadExactly) {
  for (const float slope : {0.0F, 0.1F, -0.02F})
    for (const float f : {0.0F, 0.3F, 0.9F})
      EXPECT_NEAR(between(1 - slope, 1, 1 + slope, 1 + 2 * slope, f), 1 + f * slope, 1e-6F);
}

TEST(BetweenPixels, NothingIsMadeUpAtAnEdge) {
  EXPECT_FLOAT_EQ(between(1, 1, 0.2F, 0.2F, 0.3F), 1);
  EXPECT_FLOAT_EQ(between(1, 1, 0.2F, 0.2F, 0.7F), 0.2F);
  EXPECT_FLOAT_EQ(between(1, 1, 0, 0, 0.3F), 1);
  EXPECT_FLOAT_EQ(between(1, 1, 0, 0, 0.7F), 0) << "nothing stays nothing";
}

TEST(BetweenPixels, SurfacesGoOnUpToAnEdge) {
  EXPECT_FLOAT_EQ(between(0.99F, 1, 0.2F, 0.2F, 0.4F), 1.004F);
  EXPECT_FLOAT_EQ(between(0.2F, 0.2F, 1, 0.99F, 0.6F), 1.004F);
}

TEST(BetweenPixels, ACornerOfTwoWallsIsNoEdge) { EXPECT_FLOAT_EQ(between(1, 0.9F, 0.8F, 0.9F, 0.5F), 0.85F); }

TEST(BetweenPixels, AThinThingStaysThin) {
  EXPECT_FLOAT_EQ(between(0.2F, 1, 0.2F, 0.2F, 0.2F), 1);
  EXPECT_FLOAT_EQ(between(0.2F, 1, 0.2F, 0.2F, 0.6F), 0.2F);
}

}  // namespace
}  // namespace muro::zbuffer
