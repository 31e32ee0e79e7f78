// SPDX-License-Identifier: MIT
#include "interpolate.hpp"

#include <gtest/gtest.h>

namespace muro::zbuffer {
namespace {

/// Interpolates one float and a vector of eight, which must agree.
float interpolate(float a, float b, float c, float d, float f) {
  const auto eight = [](float x) { return Float8{x, x, x, x, x, x, x, x}; };
  const float one = zbuffer::interpolate<float>(a, b, c, d, f);
  const Float8 all = zbuffer::interpolate<Float8>(eight(a), eight(b), eight(c), eight(d), eight(f));
  for (int k = 0; k < 8; ++k) EXPECT_EQ(all[k], one);
  return one;
}

TEST(InterpolationOfPixels, APlaneIsReadExactly) {
  for (const float slope : {0.0F, 0.1F, -0.02F})
    for (const float f : {0.0F, 0.3F, 0.9F})
      EXPECT_NEAR(interpolate(1 - slope, 1, 1 + slope, 1 + 2 * slope, f), 1 + f * slope, 1e-6F);
}

TEST(InterpolationOfPixels, NoValueIsInventedAtAnEdge) {
  EXPECT_FLOAT_EQ(interpolate(1, 1, 0.2F, 0.2F, 0.3F), 1);
  EXPECT_FLOAT_EQ(interpolate(1, 1, 0.2F, 0.2F, 0.7F), 0.2F);
  EXPECT_FLOAT_EQ(interpolate(1, 1, 0, 0, 0.3F), 1);
  EXPECT_FLOAT_EQ(interpolate(1, 1, 0, 0, 0.7F), 0) << "nothing stays nothing";
}

TEST(InterpolationOfPixels, SurfacesAreExtrapolatedToAnEdge) {
  EXPECT_FLOAT_EQ(interpolate(0.99F, 1, 0.2F, 0.2F, 0.4F), 1.004F);
  EXPECT_FLOAT_EQ(interpolate(0.2F, 0.2F, 1, 0.99F, 0.6F), 1.004F);
}

TEST(InterpolationOfPixels, ACornerOfTwoWallsIsNoEdge) {
  EXPECT_FLOAT_EQ(interpolate(1, 0.9F, 0.8F, 0.9F, 0.5F), 0.85F);
}

TEST(InterpolationOfPixels, AThinObjectStaysThin) {
  EXPECT_FLOAT_EQ(interpolate(0.2F, 1, 0.2F, 0.2F, 0.2F), 1);
  EXPECT_FLOAT_EQ(interpolate(0.2F, 1, 0.2F, 0.2F, 0.6F), 0.2F);
}

}  // namespace
}  // namespace muro::zbuffer
