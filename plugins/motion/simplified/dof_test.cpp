// SPDX-License-Identifier: MIT
#include "dof.hpp"

#include <gtest/gtest.h>

namespace muro::simplified {
namespace {

constexpr double dof_step = 1e-3;

TEST(Dof, AConstantForceCarriesItAsInTheTextbook) {
  DofState s{0.3, -1};
  for (int n = 0; n < 1000; ++n) s = integrate_force(s, 4, 2, {}, dof_step);
  EXPECT_NEAR(s.velocity, -1 + 2, 1e-12);
  EXPECT_NEAR(s.position, 0.3 - 1 + 1, 1e-12);
}

TEST(Dof, DampingSlowsItExponentially) {
  DofState s{0, 3};
  for (int n = 0; n < 1000; ++n) s = integrate_force(s, 0, 2, {.damping = 5}, dof_step);
  EXPECT_NEAR(s.velocity, 3 * std::exp(-2.5),
              3 * std::exp(-2.5) * 2 * 2.5 * dof_step);  // backward Euler: a^2 t * step / 2
  EXPECT_NEAR(s.position, 3 * 2 / 5.0 * (1 - std::exp(-2.5)), 2e-3);
}

TEST(Dof, DampingIsStableHoweverStrong) {
  DofState s{0, 3};
  for (int n = 0; n < 10; ++n) s = integrate_force(s, 7, 2, {.damping = 1e9}, dof_step);
  EXPECT_NEAR(s.velocity, 7e-9, 1e-15);
}

TEST(Dof, FrictionStopsItAfterTheTextbookWay) {
  DofState s{0, 1.5};
  for (int n = 0; n < 3000; ++n) s = integrate_force(s, 0, 2, {.friction = 3}, dof_step);
  EXPECT_NEAR(s.position, 1.5 * 1.5 * 2 / (2 * 3), 1e-9);  // v^2 M / 2 f
  EXPECT_EQ(s.velocity, 0);
}

TEST(Dof, FrictionHoldsBelowItsLimitAndNotAbove) {
  DofState held{0.1, 0}, moved{0.1, 0};
  for (int n = 0; n < 1000; ++n) held = integrate_force(held, -3, 2, {.friction = 3}, dof_step);
  for (int n = 0; n < 1000; ++n) moved = integrate_force(moved, -3.2, 2, {.friction = 3}, dof_step);
  EXPECT_EQ(held.position, 0.1);
  EXPECT_EQ(held.velocity, 0);
  EXPECT_NEAR(moved.velocity, -0.1, 1e-12);
}

TEST(Dof, StopsDeadAtALimitAndLeavesIt) {
  const JointLimits limits{.lower = -1, .upper = 0.5};
  DofState s{0, 2};
  for (int n = 0; n < 1000; ++n) s = integrate_force(s, 1, 2, limits, dof_step);
  EXPECT_EQ(s.position, 0.5);
  EXPECT_EQ(s.velocity, 0);
  for (int n = 0; n < 1000; ++n) s = integrate_force(s, -1, 2, limits, dof_step);
  EXPECT_NEAR(s.position, 0.5 - 0.25, 1e-12);
}

TEST(Dof, ADriveIsNoFasterThanItsLimit) {
  DofState s{};
  double effort = 0;
  for (int n = 0; n < 5000; ++n) s = integrate_effort(s, effort = -9, 0, 2, {.velocity = 3}, dof_step);
  EXPECT_EQ(s.velocity, -3);
  EXPECT_NEAR(effort, 0, 1e-12) << "what holds this speed";
}

TEST(Dof, ALoadIsFasterThanTheLimitOfTheDrive) {
  DofState passive{}, driven{};
  double effort = 0;
  for (int n = 0; n < 1000; ++n) {
    passive = integrate_effort(passive, effort = 0, -9, 2, {.velocity = 3}, dof_step);
    driven = integrate_effort(driven, effort = -1, -9, 2, {.velocity = 3}, dof_step);
  }
  EXPECT_NEAR(passive.velocity, -4.5, 1e-9);
  EXPECT_LT(driven.velocity, -4.5) << "helped by the drive as far as 3 rad/s";
  EXPECT_EQ(effort, 0);
}

TEST(Dof, AnUndampedSpringKeepsItsEnergyInTheMiddleOfSteps) {
  // Drift, kick, drift: the force belongs to the middle of the step, like that of DecoupledDynamics.
  DofState s{1, 0};
  for (int n = 0; n < 1000000; ++n)
    s = integrate_force(s, -25 * (s.position + 0.5 * dof_step * s.velocity), 1, {}, dof_step);
  EXPECT_NEAR(25 * s.position * s.position + s.velocity * s.velocity, 25, 25e-5);
}

TEST(Dof, TheInverseGivesTheEffortThatMovesItSo) {
  for (const double to : {-2.0, 0.0, 0.7})
    for (const double load : {-8.0, 0.5, 3.0}) {
      const JointLimits limits{.damping = 0.4, .friction = 1};
      const double effort = inverse_dynamics(0.6, to, load, 2, limits, dof_step);
      EXPECT_NEAR(integrate_force({0, 0.6}, effort + load, 2, limits, dof_step).velocity, to, 1e-12);
    }
  EXPECT_EQ(inverse_dynamics(0, 0, 0.9, 2, {.friction = 1}, dof_step), 0) << "friction holds the load";
  EXPECT_NEAR(inverse_dynamics(0, 0, 3, 2, {.friction = 1}, dof_step), -2, 1e-12);
}

TEST(Dof, ADriveAcceleratesByItsEffortAndGivesWayToAHeavyLoad) {
  const JointLimits limits{.effort = 4};
  const Drive drive{Mode::velocity, 100, 1000};
  DofState s{};
  double effort = 0;
  for (int n = 0; n < 1000; ++n) s = follow_target(s, drive, 0, 2, limits, dof_step, effort);
  EXPECT_NEAR(s.velocity, 2, 1e-9);
  EXPECT_NEAR(effort, 4, 1e-9);
  const Drive hold{Mode::position, 0, 1000};
  DofState light{}, heavy{};
  for (int n = 0; n < 1000; ++n) light = follow_target(light, hold, 3.9, 2, limits, dof_step, effort);
  EXPECT_EQ(light.position, 0);
  EXPECT_NEAR(effort, -3.9, 1e-12);
  for (int n = 0; n < 1000; ++n) heavy = follow_target(heavy, hold, 5, 2, limits, dof_step, effort);
  EXPECT_NEAR(heavy.velocity, 0.5, 1e-9) << "falls with (5 - 4) / 2";
  EXPECT_EQ(effort, -4);
}

/// Returns the drive of a joint at `s` with the target `target`.
ImplicitDrive drive_to(double target, const DofState& s, const PdGains& gains) {
  return implicit_drive(gains, target - s.position, 0, dof_step);
}

TEST(Dof, APositionDriveHoldsALoadByItsStiffness) {
  DofState s{};
  double effort = 0;
  for (int n = 0; n < 8000; ++n) s = follow_drive(s, drive_to(0.1, s, {40, 18}), 3, 2, {}, dof_step, effort);
  EXPECT_NEAR(s.position, 0.1 + 3 / 40.0, 1e-9);
  EXPECT_NEAR(effort, -3, 1e-9);
}

TEST(Dof, APositionDriveIsNoStrongerAndNoFasterThanItsLimits) {
  const JointLimits limits{.velocity = 1.5, .effort = 4};
  DofState s{};
  double effort = 0;
  for (int n = 0; n < 500; ++n) s = follow_drive(s, drive_to(50, s, {40, 18}), 0, 2, limits, dof_step, effort);
  EXPECT_NEAR(s.velocity, 4 * 0.5 / 2, 1e-12);
  EXPECT_EQ(effort, 4);
  for (int n = 0; n < 500; ++n) s = follow_drive(s, drive_to(50, s, {40, 18}), -3, 2, limits, dof_step, effort);
  EXPECT_NEAR(s.velocity, 1 + (4 - 3) * 0.5 / 2, 1e-12);
  for (int n = 0; n < 1500; ++n) s = follow_drive(s, drive_to(50, s, {40, 18}), -3, 2, limits, dof_step, effort);
  EXPECT_NEAR(s.velocity, 1.5, 1e-12);
  EXPECT_NEAR(effort, 3, 1e-9) << "what holds the load at this speed";
}

TEST(Dof, FrictionHoldsAPositionDriveNearItsTarget) {
  DofState s{};
  double effort = 0;
  for (int n = 0; n < 5000; ++n)
    s = follow_drive(s, drive_to(0.1, s, {40, 0}), 0, 2, {.friction = 5}, dof_step, effort);
  EXPECT_EQ(s.position, 0) << "40 N m/rad by 0.1 rad is less than 5 N m";
  EXPECT_NEAR(effort, 4, 1e-12);
}

TEST(Dof, WithoutALimitOfEffortADriveFollowsAsIfNothingActed) {
  const Drive drive{Mode::position, 0.7, 20};
  joints::JointState<double> alone{};
  DofState loaded{};
  double effort = 0;
  for (int n = 0; n < 400; ++n) {
    joints::follow_position(alone, 0.7, JointRange{.acceleration = 20}, dof_step);
    loaded = follow_target(loaded, drive, -55, 2, {.friction = 3}, dof_step, effort);
    ASSERT_EQ(loaded.position, alone.position);
  }
  EXPECT_NEAR(effort, 52, 1e-9);
}

}  // namespace
}  // namespace muro::simplified
