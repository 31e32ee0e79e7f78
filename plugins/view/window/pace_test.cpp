// SPDX-License-Identifier: MIT
#include "pace.hpp"

#include <gtest/gtest.h>

namespace muro::view {
namespace {

/// Returns the simulated time that steps of 10 ms reach while the wall clock goes from `from` to `to`, checked each ms.
double run(Pace& pace, double simulated, double from, double to) {
  for (double wall = from; wall < to; wall += 1e-3)
    if (pace.may_go_on(simulated, wall)) simulated += 0.01;
  return simulated;
}

TEST(ThePaceOfAWindow, IsThatOfTheWallClockTimesTheSpeed) {
  for (const double speed : {0.1, 1.0, 5.0}) {
    Pace pace(speed, false);
    EXPECT_NEAR(run(pace, 0, 0, 10), 10 * speed, 0.02);
  }
}

TEST(ThePaceOfAWindow, IsAsFastAsPossibleAtSpeedNone) {
  Pace pace(0, false);
  EXPECT_NEAR(run(pace, 0, 0, 1), 10, 0.02) << "a step at each look";
}

TEST(ThePaceOfAWindow, StandsWhilePausedAndDoesNotCatchUp) {
  Pace pace(1, false);
  double t = run(pace, 0, 0, 1);
  pace.set_paused(true);
  EXPECT_EQ(run(pace, t, 1, 5), t);
  pace.set_paused(false);
  t = run(pace, t, 5, 6);
  EXPECT_NEAR(t, 2, 0.03);
}

TEST(ThePaceOfAWindow, GoesOneStepAtATime) {
  Pace pace(1, false);
  const double t = run(pace, 0, 0, 1);
  pace.step();
  EXPECT_NEAR(run(pace, t, 1, 2), t + 0.01, 1e-12);
  EXPECT_TRUE(pace.paused());
}

TEST(ThePaceOfAWindow, ChangesFromWhereItIs) {
  Pace pace(1, false);
  double t = run(pace, 0, 0, 1);
  pace.set_speed(2);
  t = run(pace, t, 1, 2);
  EXPECT_NEAR(t, 3, 0.05);
}

TEST(ThePaceOfAWindow, DoesNotRunAfterTimeThatItLost) {
  Pace pace(1, false);
  double t = run(pace, 0, 0, 1);
  t = run(pace, t, 8, 9);  // nobody calls it for 7 s
  EXPECT_NEAR(t, 2, 0.05);
}

TEST(ThePaceOfAWindow, MakesUpForAPictureThatTookLong) {
  Pace pace(1, false);
  double t = 0;
  for (double wall = 0; wall < 3; wall += 0.3) t = run(pace, t, wall + 0.15, wall + 0.3);  // half of the time
  EXPECT_NEAR(t, 3, 0.2);
}

}  // namespace
}  // namespace muro::view
