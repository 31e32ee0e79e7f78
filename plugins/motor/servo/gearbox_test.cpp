// SPDX-License-Identifier: MIT
#include "gearbox.hpp"

#include <gtest/gtest.h>

namespace muro::servo {
namespace {

/// A rotor and a joint without a controller.
struct Train {
  Gearbox gear;
  Motor motor{};
  double h = 1e-3;
  Rotor rotor{};
  double q = 0, v = 0;   ///< position and velocity of the joint
  bool clamped = false;  ///< the joint does not move

  double step(double wanted, double load = 0) {
    const double effort = gear.effort(rotor, q, v, h);
    const double given = gear.advance_rotor(rotor, wanted, motor, effort, h);
    if (clamped) return given;
    const double before = v;
    v += h * (effort - load) / gear.joint_inertia;
    q += 0.5 * h * (before + v);
    return given;
  }
  double momentum() const { return gear.rotor_inertia * rotor.velocity + gear.joint_inertia * v; }
};

TEST(Gearbox, RotorAndJointSpeedUpAsOneBody) {
  for (const double ratio : {0.1, 1.0, 10.0}) {
    Train t{.gear = {.rotor_inertia = 0.01 * ratio, .joint_inertia = 0.01}};
    for (int n = 0; n < 1000; ++n) t.step(0.2);
    EXPECT_NEAR(t.v, 0.2 / (0.01 * (1 + ratio)), 1e-9 * t.v);
    EXPECT_NEAR(t.rotor.velocity, t.v, 1e-9 * t.v);
    EXPECT_NEAR(t.momentum(), 0.2, 1e-12);
  }
}

TEST(Gearbox, TheJointStandsStillWhileTheRotorCrossesTheGap) {
  Train t{.gear = {.rotor_inertia = 0.002, .joint_inertia = 0.02, .backlash = 0.04}};
  t.rotor.position = -0.02;  // touches the lower flank
  double crossed = 0;
  for (int n = 0; n < 1000 && t.q == 0; ++n) {
    t.step(0.1);
    crossed = t.rotor.position;
  }
  // The rotor meets the other flank with M t / J = 2 rad/s; one step to reach it and one to push.
  EXPECT_NEAR(crossed, 0.02, 2 * 0.1 / 0.002 * 0.04 * t.h);
  EXPECT_GT(t.v, 0);
}

TEST(Gearbox, ImpactsInTheGapKeepTheMomentumAndLoseEnergy) {
  Train t{.gear = {.rotor_inertia = 0.002, .joint_inertia = 0.02, .backlash = 0.04}};
  t.rotor.velocity = 3;
  double last = 0.002 * 3 * 3, lowest = last;
  int impacts = 0;
  for (int n = 0; n < 100000; ++n) {
    t.step(0);
    EXPECT_NEAR(t.momentum(), 0.006, 1e-15);
    const double energy = 0.002 * t.rotor.velocity * t.rotor.velocity + 0.02 * t.v * t.v;
    const bool apart = t.gear.effort(t.rotor, t.q, t.v, t.h) == 0;
    if (!apart || energy == last) continue;
    EXPECT_LT(energy, last);
    last = energy;
    ++impacts;
    lowest = std::min(lowest, energy);
  }
  EXPECT_GE(impacts, 2);
  EXPECT_NEAR(lowest, 0.006 * 0.006 / 0.022, 1e-4 * lowest) << "in the end they move as one";
}

TEST(Gearbox, APositionSeenAtTheMotorHasTheGapAsHysteresis) {
  Train t{.gear = {.rotor_inertia = 0.002, .joint_inertia = 0.02, .friction = 0.02, .backlash = 0.03}};
  const auto go_to = [&](double goal) {
    for (int n = 0; n < 4000; ++n) {
      t.step(5 * (goal - t.rotor.position) - 0.2 * t.rotor.velocity, 0.05 * t.v);
      t.v = std::abs(t.v) < 1e-9 ? 0 : t.v;
    }
    return t.q - t.rotor.position;
  };
  go_to(-1);
  const double upwards = go_to(0.5), downwards = [&] {
    go_to(1.5);
    return go_to(0.5);
  }();
  EXPECT_LE(std::abs(upwards), 0.015 + 1e-4);
  EXPECT_LE(std::abs(downwards), 0.015 + 1e-4);
  EXPECT_GT(std::abs(upwards - downwards), 0) << "the joint lies elsewhere in the gap";
}

TEST(Gearbox, FrictionHoldsBelowItsLimitWithoutAMove) {
  Train t{.gear = {.rotor_inertia = 0.002, .joint_inertia = 0.02, .friction = 0.5}};
  for (int n = 0; n < 5000; ++n) t.step(0.499);
  EXPECT_EQ(t.rotor.position, 0);
  EXPECT_EQ(t.q, 0);
  for (int n = 0; n < 1000; ++n) t.step(0.61);
  EXPECT_NEAR(t.v, (0.61 - 0.5) / 0.022, 1e-6);
}

TEST(Gearbox, FrictionStopsItInTheTextbookWay) {
  Train t{.gear = {.rotor_inertia = 0.01, .joint_inertia = 0.01, .friction = 0.4}};
  t.rotor.velocity = t.v = 2;
  for (int n = 0; n < 2000; ++n) t.step(0);
  EXPECT_NEAR(t.q, 2 * 2 * 0.02 / (2 * 0.4), 2 * t.h);
  EXPECT_LT(std::abs(t.v), 1e-9);
  EXPECT_EQ(t.rotor.velocity, 0);
}

TEST(Gearbox, TheEfficiencyIsWhatOfTheMotorsEffortReachesALoad) {
  // Raising a load M steadily takes M / eta of the motor; below M (2 - 1/eta) the load drives it back.
  for (const double eta : {0.9, 0.7, 0.4}) {
    Train t{.gear = {.rotor_inertia = 0.01, .joint_inertia = 0.02, .loss = 1 / eta - 1}};
    for (int n = 0; n < 1000; ++n) t.step(1.001 / eta, 1);
    EXPECT_GT(t.v, 0) << eta;
    Train held{.gear = t.gear};
    for (int n = 0; n < 20; ++n) held.step(1, 1);  // takes up the load
    const double back = 2 - 1 / eta;
    for (int n = 0; n < 3000; ++n) held.step(back > 0 ? 1.01 * back : 0, 1);
    EXPECT_LT(std::abs(held.v), 1e-9) << eta << (back <= 0 ? ": locks itself" : "");
    if (back <= 0) continue;
    for (int n = 0; n < 1000; ++n) held.step(0.98 * back, 1);
    EXPECT_LT(held.v, -0.01) << eta;
  }
}

TEST(Gearbox, TheMotorSettlesWhereItsLineMeetsTheLoad) {
  Train t{.gear = {.rotor_inertia = 0.01, .joint_inertia = 0.02}, .motor = {.stall = 2, .slope = 0.4}};
  for (int n = 0; n < 5000; ++n) t.step(100, 1.2);
  EXPECT_NEAR(t.v, (2 - 1.2) / 0.4, 1e-9);
  EXPECT_NEAR(t.step(100, 1.2), 1.2, 1e-9);
  for (int n = 0; n < 5000; ++n) t.step(100, -0.6);
  EXPECT_NEAR(t.v, (2 + 0.6) / 0.4, 1e-9) << "the load turns it faster than its no-load speed: braked on the line";
}

TEST(Gearbox, TheMotorsLineIsStableHoweverSteep) {
  Train t{.gear = {.rotor_inertia = 1e-4, .joint_inertia = 1e-4}, .motor = {.stall = 50, .slope = 10}};
  for (int n = 0; n < 3000; ++n) t.step(100);
  EXPECT_NEAR(t.v, 5, 1e-9) << "slope h / J is 100";
}

TEST(Gearbox, RunsUnloadedAtTheSpeedThatItsFrictionLeaves) {
  Train t{.gear = {.rotor_inertia = 0.01, .joint_inertia = 0.02, .friction = 0.1, .viscous = 0.05},
          .motor = {.stall = 2, .slope = 0.4}};
  for (int n = 0; n < 5000; ++n) t.step(100);
  EXPECT_NEAR(t.v, (2 - 0.1) / 0.45, 1e-9);
}

TEST(Gearbox, ASoftGearBendsByEffortByStiffness) {
  Train t{.gear = {.rotor_inertia = 0.01, .joint_inertia = 0.02, .stiffness = 50}};
  t.clamped = true;
  for (int n = 0; n < 5000; ++n) t.step(1.5);
  EXPECT_NEAR(t.rotor.position, 1.5 / 50, 1e-9);
}

TEST(Gearbox, IsStableWhateverTheRate) {
  for (const double h : {1e-4, 1e-3, 1e-2, 0.05}) {
    Train t{.gear = {.rotor_inertia = 0.01, .joint_inertia = 0.02, .backlash = 0.02, .stiffness = 1e6}, .h = h};
    for (int n = 0; n < 2000; ++n) t.step(0.1);
    EXPECT_NEAR(t.rotor.position - t.q, 0.01 + 0.1 * 2 / 3 / t.gear.max_stiffness(h), 1e-9 + 1e-9 * t.q) << h;
    EXPECT_NEAR(t.rotor.velocity, t.v, 1e-9 * t.v) << h;
  }
}

TEST(Gearbox, IsStableWithAJointFourTimesLighterThanItWasTakenFor) {
  Train t{.gear = {.rotor_inertia = 0.1, .joint_inertia = 0.02, .backlash = 0.01}};
  t.rotor.velocity = 0.1;
  for (int n = 0; n < 5000; ++n) {
    const double effort = t.gear.effort(t.rotor, t.q, t.v, t.h), before = t.v;
    t.gear.advance_rotor(t.rotor, 0, t.motor, effort, t.h);
    t.v += t.h * effort / 0.005;
    t.q += 0.5 * t.h * (before + t.v);
    ASSERT_LT(std::abs(t.rotor.position - t.q), 0.006);
  }
}

}  // namespace
}  // namespace muro::servo
