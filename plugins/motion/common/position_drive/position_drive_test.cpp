// SPDX-License-Identifier: MIT
#include "position_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muro {
namespace {

TEST(PositionDrive, IsCriticallyDampedByTheInertiaThatItMoves) {
  const PositionDrive drive{.natural_frequency = 30};
  const PdGains gains = drive.gains(0.2);
  EXPECT_NEAR(gains.stiffness, 900 * 0.2, 1e-12);
  EXPECT_NEAR(gains.damping * gains.damping, 4 * gains.stiffness * 0.2, 1e-9);  // discriminant of the oscillator
  const PdGains soft = PositionDrive{.natural_frequency = 30, .stiffness = 5}.gains(0.2);
  EXPECT_EQ(soft.stiffness, 5);
  EXPECT_NEAR(soft.damping * soft.damping, 4 * 5 * 0.2, 1e-12);
  const PdGains given = PositionDrive{.stiffness = 5, .damping = 0}.gains(0.2);
  EXPECT_EQ(given.damping, 0);
}

/// Returns x after `time` for a mass of 0.2 that such a drive pulls from 1 to 0, and its largest speed.
double pulled(const PdGains& gains, double time, double dt, double* fastest = nullptr) {
  double x = 1, v = 0;
  for (double t = 0; t < time - 0.5 * dt; t += dt) {
    const ImplicitDrive d = implicit_drive(gains, -x, 0, dt);
    v = (0.2 * v + dt * d.damping * d.velocity) / (0.2 + dt * d.damping);
    x += dt * v;
    if (fastest) *fastest = std::max(*fastest, std::abs(v));
  }
  return x;
}

TEST(PositionDrive, GoesToItsTargetAsTheOscillatorDoes) {
  const PdGains gains = PositionDrive{.natural_frequency = 20}.gains(0.2);
  for (const double t : {0.05, 0.1, 0.3}) {
    const double exact = (1 + 20 * t) * std::exp(-20 * t);
    EXPECT_NEAR(pulled(gains, t, 1e-5), exact, 2e-4);
    EXPECT_NEAR(pulled(gains, t, 1e-3), exact, 1e-2) << "first order in the step";
  }
}

TEST(PositionDrive, IsStableHoweverStiff) {
  for (const double stiffness : {1e3, 1e6, 1e12})
    for (const double damping : {0.0, 1.0}) {
      double fastest = 0;
      EXPECT_NEAR(pulled({stiffness, damping}, 6, 1e-3, &fastest), 0, 1e-3) << stiffness;
      EXPECT_LE(fastest, 1 / 1e-3);
    }
}

TEST(PositionDrive, TellsTheEffortOfItsLaw) {
  const ImplicitDrive d = implicit_drive({50, 3}, 0.2, 0.4, 0.01);
  EXPECT_NEAR(d.effort(0.7), 50 * (0.2 - 0.01 * 0.7) + 3 * (0.4 - 0.7), 1e-12);
  EXPECT_EQ(implicit_drive({0, 0}, 1, 1, 0.01).effort(5), 0);
}

}  // namespace
}  // namespace muro
