// SPDX-License-Identifier: MIT
// muro/base/motor_model.hpp against closed forms, and against speeds measured at an MX-64.
#include "muro/base/motor_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muro::motor {
namespace {

/// MX-64, M1, identified by Rhoban/bam.
constexpr MotorModel mx64{.kt = 1.622,
                          .resistance = 3.949,
                          .armature = 0.01195,
                          .gain = 32 * 0.158,
                          .duty_limit = 0.9625,
                          .friction = {.coulomb = 0.0904, .viscous = 0.0117}};

/// Returns rad/s after `duration` (s) with the voltage on, without load, in steps of `dt`.
double speed_after(const MotorModel& m, double voltage, double duration, double dt) {
  double w = 0;
  for (int k = 0; k < int(std::lround(duration / dt)); ++k) {
    const double torque = m.torque(voltage, w);
    w = next_velocity(w, torque, m.friction.budget(w, torque, 0), m.armature, dt);
  }
  return w;
}

TEST(MotorModel, HasTheFiguresOfTheClosedForms) {
  EXPECT_NEAR(mx64.no_load_speed(12), 7.135, 3e-3) << "published figures have four digits";
  EXPECT_NEAR(mx64.no_load_speed(15), 8.953, 3e-3);
  EXPECT_NEAR(mx64.stall_torque(12), 4.84, 5e-3);
  EXPECT_NEAR(mx64.time_constant(0), 17.6e-3, 5e-5);
}

TEST(MotorModel, AStepOfTheVoltageIsExponential) {
  const double w0 = mx64.no_load_speed(12), constant = mx64.time_constant(0);
  EXPECT_NEAR(speed_after(mx64, 12, 1, 1e-4), w0, 1e-9);
  const auto error = [&](double dt) {
    double most = 0;
    for (const double t : {0.01, 0.02, 0.04})
      most = std::max(most, std::abs(speed_after(mx64, 12, t, dt) - w0 * (1 - std::exp(-t / constant))));
    return most;
  };
  EXPECT_LT(error(1e-4), 7.5e-3);
  EXPECT_NEAR(error(1e-4) / error(5e-5), 2, 0.02) << "it halves with the step";
}

TEST(MotorModel, AnMx64TurnsAsFastAsItDoesAtFifteenVoltages) {
  // Rhoban/bam, atomic/data/velocity_mx64.json: rad/s at 1 .. 15 V without load
  constexpr double measured[] = {0.53198, 1.12073, 1.70456, 2.29023, 2.87867, 3.46557, 4.05738, 4.63814,
                                 5.22198, 5.81624, 6.40007, 7.00109, 7.60517, 8.19146, 8.77406};
  for (int volts = 1; volts <= 15; ++volts)
    EXPECT_NEAR(mx64.no_load_speed(volts), measured[volts - 1], 0.185) << volts << " V";
  const double slope = (mx64.no_load_speed(15) - mx64.no_load_speed(1)) / 14;
  EXPECT_NEAR(slope, 0.5889, 0.03 * 0.5889) << "rad/s by V of the measured line";
}

TEST(MotorModel, FrictionHoldsWhatItCanToTheLastBit) {
  // a pendulum of 0.49 kg at 0.1 m, held by friction alone
  const double inertia = 0.49 * 0.01, weight = 0.49 * 9.81 * 0.1, most = 0.2;
  for (const double angle : {0.0, 0.1, -0.3, std::asin(most / weight) - 1e-12, std::asin(most / weight) + 1e-6}) {
    double q = angle, w = 0;
    for (int k = 0; k < 10000; ++k) {
      const double v = next_velocity(w, -weight * std::sin(q), most, inertia, 1e-3);
      q += 0.5e-3 * (w + v), w = v;
    }
    if (weight * std::abs(std::sin(angle)) <= most) {
      EXPECT_EQ(q, angle);
    } else {
      EXPECT_LT(q, angle) << "what it cannot hold moves";
    }
  }
}

TEST(MotorModel, CoulombAndViscousFrictionStopACoastingLink) {
  // J w' = -Kc - Kv w: at rest after (J / Kv) ln(1 + Kv w0 / Kc), and not one step longer
  const FrictionModel f{.coulomb = 0.05, .viscous = 0.02};
  const double inertia = 0.01, dt = 1e-5, rest = inertia / f.viscous * std::log(1 + f.viscous * 5 / f.coulomb);
  double w = 5;
  int steps = 0;
  for (; w != 0; ++steps) w = next_velocity(w, 0, f.budget(w, 0, 0), inertia, dt);
  EXPECT_NEAR(steps * dt, rest, 1e-4);
  EXPECT_GT(w + 1, 0) << "it does not turn back";
}

TEST(MotorModel, TheBudgetsAreThoseOfModels2To4) {
  const FrictionModel m2{
      .coulomb = 0.1, .viscous = 0.02, .stribeck = 0.3, .stribeck_velocity = 2, .stribeck_exponent = 1.5};
  EXPECT_EQ(m2.budget(0, 5, 1), 0.1 + 0.3);
  EXPECT_NEAR(m2.budget(-2, 5, 1), 0.1 + 0.04 + 0.3 * std::exp(-1), 1e-15);
  const FrictionModel m3{.coulomb = 0.1, .viscous = 0.02, .load = 0.25};
  EXPECT_NEAR(m3.budget(1, 2, -2), 0.1 + 0.02 + 0.25 * 4, 1e-15) << "a motor that holds a load";
  EXPECT_NEAR(m3.budget(1, 2, 2), 0.12, 1e-15) << "both push alike: the gear is unloaded";
  const FrictionModel m4{.coulomb = 0.1,
                         .stribeck = 0.3,
                         .stribeck_velocity = 2,
                         .stribeck_exponent = 1.5,
                         .load = 0.25,
                         .load_stribeck = 0.5};
  EXPECT_NEAR(m4.budget(2, 1, -1), 0.1 + 0.5 + std::exp(-1) * (0.3 + 0.5 * 2), 1e-15);
}

TEST(MotorModel, TheLoadIsFoundFromTheMotion) {
  const double inertia = 0.02, dt = 1e-3, load = -0.7, torque = 1.5, budget = 0.3;
  const double moving = next_velocity(2, torque + load, budget, inertia, dt);
  EXPECT_NEAR(LoadObserver::load(moving, moving - 2, torque, budget, inertia, 0, dt), load, 1e-12);
  const double back = next_velocity(-2, torque + load, budget, inertia, dt);
  EXPECT_NEAR(LoadObserver::load(back, back + 2, torque, budget, inertia, 0, dt), load, 1e-12);
  // at rest friction hides the load: the observer keeps its last value, as far as that is possible
  EXPECT_EQ(LoadObserver::load(0, 0, 0.2, budget, inertia, -0.1, dt), -0.1);
  EXPECT_EQ(LoadObserver::load(0, 0, 1.0, budget, inertia, -0.1, dt), -0.7);
}

TEST(MotorModel, DutyIsTheErrorByTheGainWithinItsLimit) {
  EXPECT_EQ(mx64.duty(0.01), 32 * 0.158 * 0.01);
  EXPECT_EQ(mx64.duty(3), 0.9625);
  EXPECT_EQ(mx64.duty(-3), -0.9625);
}

}  // namespace
}  // namespace muro::motor
