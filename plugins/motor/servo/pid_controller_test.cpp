// SPDX-License-Identifier: MIT
#include "pid_controller.hpp"

#include <gtest/gtest.h>

#include "encoder.hpp"
#include "motor.hpp"

namespace muro::servo {
namespace {

constexpr EffortLimits no_limits{-1e30, 1e30};

TEST(PidController, AnswersAStepAsTheSecondOrderSystem) {
  // J q'' = k (q* - q) - d q': overshoot exp(-pi z / sqrt(1 - z^2)) at the time pi / (w sqrt(1 - z^2)).
  const double inertia = 0.02, k = 8, w = std::sqrt(k / inertia), zeta = 0.3, h = 1e-5;
  const PidController pd{.stiffness = k, .damping = 2 * zeta * w * inertia};
  double q = 0, v = 0, integral = 0, peak = 0, when = 0;
  for (int n = 0; n < 40000; ++n) {
    const double a = pd.effort(1, q, v, no_limits, integral, h) / inertia;
    q += h * (v + 0.5 * h * a), v += h * a;
    if (q > peak) peak = q, when = (n + 1) * h;
  }
  const double damped = std::sqrt(1 - zeta * zeta);
  EXPECT_NEAR(peak - 1, std::exp(-M_PI * zeta / damped), 1e-3);
  EXPECT_NEAR(when, M_PI / (w * damped), 1e-3 * when);
  EXPECT_EQ(integral, 0);
}

TEST(PidController, TheIntegralTakesTheErrorUnderALoadAway) {
  const double inertia = 0.02, load = 1.5, h = 1e-4;
  for (const double gain : {0.0, 100.0}) {
    const PidController pid{.stiffness = 20, .damping = 1, .integral = gain};
    double q = 0, v = 0, integral = 0;
    for (int n = 0; n < 100000; ++n) {
      v += h * (pid.effort(0, q, v, no_limits, integral, h) - load) / inertia;
      q += h * v;
    }
    EXPECT_NEAR(q, gain > 0 ? 0 : -load / 20, 1e-9);
    EXPECT_NEAR(integral, gain > 0 ? load : 0, 1e-7);
  }
}

TEST(PidController, TheIntegralDoesNotWindUpAtALimit) {
  // Held for 10 s: without anti-windup the integral would hold 5000 N m.
  const PidController pid{.stiffness = 20, .damping = 1, .integral = 500};
  const EffortLimits limits{-2, 2};
  double integral = 0;
  for (int n = 0; n < 10000; ++n) EXPECT_EQ(pid.effort(1, 0, 0, limits, integral, 1e-3), 2);
  EXPECT_LE(integral, 2);
  EXPECT_LT(pid.effort(1, 1.2, 0, limits, integral, 1e-3), 0) << "turns round at once";
}

TEST(PidController, FollowsAVelocityUnderALoadWithoutError) {
  const double inertia = 0.02, load = 1.5, h = 1e-4;
  const PidController pi{.follows_velocity = true, .stiffness = 10, .damping = 0.5};
  double v = 0, integral = 0;
  for (int n = 0; n < 50000; ++n) v += h * (pi.effort(3, 0, v, no_limits, integral, h) - load) / inertia;
  EXPECT_NEAR(v, 3, 1e-9);
}

TEST(Encoder, ReadsWholeSteps) {
  const Encoder encoder{.resolution = 2 * M_PI / 4096};
  EXPECT_DOUBLE_EQ(encoder.reading(0.1), 65 * 2 * M_PI / 4096);
  EXPECT_EQ(encoder.reading(0.5 * 2 * M_PI / 4096 * 0.99), 0);
  EXPECT_DOUBLE_EQ(encoder.measured_speed(0.2, 0.1, 0, 77, 0.01), 10) << "from readings, not the true one";
  EXPECT_EQ(Encoder{}.measured_speed(0.2, 0.1, 0, 77, 0.01), 77);
}

TEST(Encoder, TheFilterOfTheSpeedHasItsTimeConstant) {
  const Encoder encoder{.filter = 0.05};
  double speed = 0;
  for (int n = 0; n < 500; ++n) speed = encoder.measured_speed(0, 0, speed, 1, 1e-4);
  EXPECT_NEAR(speed, 1 - std::exp(-1), 1e-3);
}

TEST(Motor, HasTheLineOfItsDataSheetInFourQuadrants) {
  // Dynamixel XM430-W350 at 12 V: 4.1 N m at standstill, 46 rpm unloaded.
  const double stall = 4.1, no_load_speed = 46 * 2 * M_PI / 60;
  const Motor motor{.stall = stall, .slope = stall / no_load_speed};
  EXPECT_EQ(motor.limits(0).max, stall);
  EXPECT_EQ(motor.limits(0).min, -stall);
  EXPECT_NEAR(motor.limits(no_load_speed).max, 0, 1e-12);
  EXPECT_NEAR(motor.limits(-no_load_speed).min, 0, 1e-12);
  EXPECT_NEAR(motor.limits(0.5 * no_load_speed).max, 0.5 * stall, 1e-12);
  EXPECT_NEAR(motor.limits(0.5 * no_load_speed).min, -1.5 * stall, 1e-12) << "full reverse voltage brakes harder";
  EXPECT_NEAR(motor.limits(1.5 * no_load_speed).max, -0.5 * stall, 1e-12) << "a load that turns it too fast is braked";
}

TEST(Motor, TheLimitOfTheCurrentCutsTheLine) {
  const Motor motor{.stall = 4, .slope = 1, .max_effort = 2};
  EXPECT_EQ(motor.limits(0).max, 2);
  EXPECT_EQ(motor.limits(3).max, 1);
  EXPECT_EQ(motor.limits(3).min, -2);
}

}  // namespace
}  // namespace muro::servo
