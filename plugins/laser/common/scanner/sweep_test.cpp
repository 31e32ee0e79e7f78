// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace muro::scanner {
namespace {

using std::numbers::pi;

TEST(ASweep, TakesEveryColumnOnceWhenTheMirrorPointsThere) {
  // the URG-04LX: 1024 steps of the mirror in a turn of 100 ms, 682 of them measured
  const Grid urg{.min_angle = 0, .max_angle = 681 * 2 * pi / 1024, .columns = 682};
  for (const std::uint32_t steps : {2u, 7u, 100u, 5000u}) {
    const Sweep sweep(urg, false, steps);
    ASSERT_EQ(sweep.steps(), steps);
    std::uint32_t column = 0;
    for (std::uint32_t k = 0; k < steps; ++k) {
      EXPECT_EQ(sweep.first(k), column);
      for (; column < sweep.first(k + 1); ++column)
        EXPECT_NEAR((k + sweep.time_fraction(column)) / steps, column / 1024.0, 1e-12) << "in revolutions";
    }
    EXPECT_EQ(column, 682u);
    EXPECT_EQ(sweep.last_step(), std::uint32_t(681.0 / 1024 * steps));
  }
}

TEST(ASweep, SpreadsTheRaysOfAListOverTheScan) {
  const Sweep sweep({.columns = 8}, true, 4);
  for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(sweep.first(k), 2 * k);
  EXPECT_EQ(sweep.time_fraction(0), 0);
  EXPECT_EQ(sweep.time_fraction(1), 0.5);
}

}  // namespace
}  // namespace muro::scanner
