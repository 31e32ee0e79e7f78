// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/schedule/rate.hpp"

namespace muro {
namespace {

TEST(Rate, RunsAtTheFloorOfTheExactTimeWithoutDrift) {
  EXPECT_EQ(Rate(3).time_of(1), 333'333'333);
  EXPECT_EQ(Rate(3).time_of(3), 1'000'000'000);
  EXPECT_EQ(Rate(29.97).time_of(2997), 100'000'000'000);
  EXPECT_EQ(Rate(1000).time_of(86'400'000), 86'400'000'000'000);  // after a day, exact to the nanosecond
  EXPECT_EQ(Rate(0.1).time_of(7), 70'000'000'000);
}

TEST(Rate, RefusesWhatCannotBeARate) {
  for (const double wrong :
       {-5.0, 1e-7, 1e10, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(Rate{wrong}, SetupError) << wrong;
  EXPECT_TRUE(Rate(0).on_demand());
}

TEST(Rate, FindsTheFirstRunFromATimeOn) {
  for (const double hertz : {0.3, 1.0, 3.0, 7.0, 29.97, 60.0, 1000.0, 1234.567})
    for (std::uint64_t k = 0; k < 2000; k += 7) {
      const Rate r(hertz);
      EXPECT_EQ(r.first_from(r.time_of(k)), k) << hertz;
      EXPECT_EQ(r.first_from(r.time_of(k) + 1), k + 1) << hertz;
    }
}

}  // namespace
}  // namespace muro
