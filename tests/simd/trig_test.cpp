// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "each_isa.hpp"
#include "muro/base/elementary.hpp"

namespace muro::lane_test {
namespace {

struct Found {
  double sines[values], cosines[values];
};
Found sincos(lane::Isa isa, Width width, const double (&angles)[values]) {
  Found f;
  kernels_for(isa).sincos(width, angles, f.sines, f.cosines);
  return f;
}

/// Draws angles of all sizes up to 10^6, many of them close to a multiple of pi/4.
void draw(std::mt19937& random, double (&angles)[values]) {
  std::uniform_real_distribution<double> unit(-1, 1);
  for (double& a : angles) {
    a = unit(random) * std::pow(10, 6 * std::abs(unit(random)));
    if (unit(random) > 0.5) a = M_PI / 4 * std::round(a) + 1e-7 * unit(random) * unit(random);
    if (std::abs(a) > 1e6) a = unit(random);
  }
}

/// Returns the error of a double `value` in units in the last place.
double ulps(double value, long double exact) {
  int exponent = 0;
  std::frexp(exact, &exponent);
  return double(std::abs(std::ldexp((long double)(value)-exact, std::numeric_limits<double>::digits - exponent)));
}

TEST(SinCos, IsWithinOneUnitInTheLastPlace) {
  std::mt19937 random(1);
  double angles[values], worst = 0;
  for (int round = 0; round < 20000; ++round) {
    draw(random, angles);
    const Found f = sincos(lane::best_isa(), Width::eight, angles);
    for (int i = 0; i < values; ++i) {
      worst = std::max(worst, ulps(f.sines[i], std::sin((long double)(angles[i]))));
      worst = std::max(worst, ulps(f.cosines[i], std::cos((long double)(angles[i]))));
    }
  }
  EXPECT_LE(worst, 1);
  EXPECT_GT(worst, 0) << "nothing was compared";
}

TEST(SinCos, ALaneHasTheBitsOfOneDoubleWithAnyInstructionSet) {
  std::mt19937 random(2);
  double angles[values];
  for (int round = 0; round < 10000; ++round) {
    draw(random, angles);
    if (round % 3 == 0) angles[round % values] *= 1e9;
    for (const lane::Isa isa : each_isa())
      for (const Width width : {Width::one, Width::eight}) {
        const Found f = sincos(isa, width, angles);
        for (int i = 0; i < values; ++i) {
          const auto [sine, cosine] = elementary::sincos(angles[i]);
          ASSERT_EQ(std::bit_cast<std::uint64_t>(f.sines[i]), std::bit_cast<std::uint64_t>(sine)) << angles[i];
          ASSERT_EQ(std::bit_cast<std::uint64_t>(f.cosines[i]), std::bit_cast<std::uint64_t>(cosine)) << angles[i];
        }
      }
  }
}

TEST(SinCos, IsRightForHugeAnglesAndNoNumberForNone) {
  const double angles[values] = {1e7, -1e9, 1e17, HUGE_VAL, -HUGE_VAL, std::nan(""), 0.5, 1e6, -2e6};
  for (const lane::Isa isa : each_isa()) {
    const Found f = sincos(isa, Width::eight, angles);
    for (const int i : {0, 1, 2, 6, 7, 8}) {
      EXPECT_LE(ulps(f.sines[i], std::sin((long double)(angles[i]))), 1) << angles[i];
      EXPECT_LE(ulps(f.cosines[i], std::cos((long double)(angles[i]))), 1) << angles[i];
    }
    for (const int i : {3, 4, 5}) EXPECT_TRUE(std::isnan(f.sines[i]) && std::isnan(f.cosines[i]));
    EXPECT_EQ(f.sines[9], 0);
    EXPECT_EQ(f.cosines[9], 1);
  }
}

TEST(SinCos, IsOddAndEven) {
  std::mt19937 random(3);
  double angles[values], opposite[values];
  for (int round = 0; round < 1000; ++round) {
    draw(random, angles);
    for (int i = 0; i < values; ++i) opposite[i] = -angles[i];
    const Found f = sincos(lane::best_isa(), Width::eight, angles),
                g = sincos(lane::best_isa(), Width::eight, opposite);
    for (int i = 0; i < values; ++i) {
      EXPECT_EQ(f.sines[i], -g.sines[i]) << angles[i];
      EXPECT_EQ(f.cosines[i], g.cosines[i]) << angles[i];
    }
  }
}

}  // namespace
}  // namespace muro::lane_test
