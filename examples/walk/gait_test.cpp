// SPDX-License-Identifier: MIT
// Footsteps against the closed forms of the linear inverted pendulum.
#include "gait.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muro::walk_test {
namespace {

using namespace walking;

/// A periodic walk without double support: m, s.
struct PeriodicWalk {
  double height, period, distance, stride;
};

GaitSettings settings_of(const PeriodicWalk& walk) {
  return {.period = walk.period,
          .double_support = 0,
          .shift = walk.period,
          .rise = 0.03,
          .foot_distance = walk.distance,
          .com_height = walk.height,
          .largest_step = {1, 1, 1},
          .largest_change = {0.01, 0.01, 0.05}};
}

constexpr PeriodicWalk placos{0.32, 0.38, 0.122, 0.08}, short_steps{0.30, 0.30, 0.086, 0.04};

/// Advances until a step begins.
void run_to_switch(Gait& gait, double h, const Velocity& v, const GaitSettings& g) {
  const Side before = gait.stance();
  while (gait.stance() == before) gait.advance(h, v, g);
}

TEST(Gait, SpeedsAtTheSwitchAreThoseOfThePendulum) {
  for (const PeriodicWalk& walk : {placos, short_steps}) {
    const GaitSettings g = settings_of(walk);
    const double h = walk.period / 100, w = std::sqrt(9.81 / walk.height), half = 0.5 * w * walk.period;
    Gait gait;
    gait.stand({}, g);
    for (int k = 0; k < 4000; ++k) gait.advance(h, {walk.stride / walk.period, 0, 0}, g);
    run_to_switch(gait, h, {walk.stride / walk.period, 0, 0}, g);
    EXPECT_NEAR(gait.along_x().velocity, w * walk.stride / 2 / std::tanh(half), 1e-9);
    EXPECT_NEAR(std::abs(gait.along_y().velocity), w * walk.distance / 2 * std::tanh(half), 1e-9);
    EXPECT_NEAR(gait.along_y().position, 0, 1e-9) << "midway between the feet";
    const double ahead = gait.along_x().capture_point(w) - gait.sole(gait.stance(), g).at.x;
    EXPECT_NEAR(ahead + walk.stride, walk.stride / 2 * (1 + 1 / std::tanh(half)), 1e-9) << "of the old foot";
    double sway = 0;
    for (int k = 0; k < 100; ++k) {
      gait.advance(h, {walk.stride / walk.period, 0, 0}, g);
      sway = std::max(sway, std::abs(gait.along_y().position));
    }
    EXPECT_NEAR(sway, walk.distance / 2 * (1 - 1 / std::cosh(half)), 1e-6);
  }
}

TEST(Gait, SpeedsOfSigmabanAreThoseOfPlacosExample) {
  // placo-examples: 0.2830 m/s forward and 0.2643 m/s to the side at the switch, at 0.2105 m/s
  const GaitSettings g = settings_of(placos);
  Gait gait;
  gait.stand({}, g);
  for (int k = 0; k < 4000; ++k) gait.advance(0.0038, {0.08 / 0.38, 0, 0}, g);
  run_to_switch(gait, 0.0038, {0.08 / 0.38, 0, 0}, g);
  EXPECT_NEAR(gait.along_x().velocity, 0.2830, 1e-4);
  EXPECT_NEAR(std::abs(gait.along_y().velocity), 0.2643, 1e-4);
}

TEST(Gait, GoesAsFarAsItIsTold) {
  const GaitSettings g = settings_of(short_steps);
  for (const Velocity& v : {Velocity{0.1, 0, 0}, Velocity{-0.1, 0.02, 0}, Velocity{0, -0.05, 0}}) {
    Gait gait;
    gait.stand({}, g);
    for (int k = 0; k < 3000; ++k) gait.advance(0.01, v, g);
    run_to_switch(gait, 0.01, v, g);
    run_to_switch(gait, 0.01, v, g);
    const Foothold before = gait.sole(gait.stance(), g).at;
    for (int k = 0; k < 20; ++k) run_to_switch(gait, 0.01, v, g);
    EXPECT_NEAR(gait.sole(gait.stance(), g).at.x - before.x, v.forward * 20 * 0.3, 1e-6);
    EXPECT_NEAR(gait.sole(gait.stance(), g).at.y - before.y, v.left * 20 * 0.3, 1e-6);
  }
}

TEST(Gait, TurnsInCircles) {
  const GaitSettings g = settings_of(short_steps);
  Gait gait;
  gait.stand({}, g);
  const Velocity v{0.1, 0, 0.5};
  for (int k = 0; k < 3000; ++k) gait.advance(0.01, v, g);
  const double before = gait.yaw(), x = gait.along_x().position, y = gait.along_y().position;
  for (int k = 0; k < 1200; ++k) gait.advance(0.01, v, g);
  EXPECT_NEAR(gait.yaw() - before, 0.5 * 12, 0.05);
  EXPECT_LT(std::hypot(gait.along_x().position - x, gait.along_y().position - y), 2 * 0.1 / 0.5 + 0.05);
}

TEST(Gait, EndsWithFeetSideBySide) {
  const GaitSettings g = settings_of(short_steps);
  Gait gait;
  gait.stand({}, g);
  for (int k = 0; k < 1000; ++k) gait.advance(0.01, {0.1, 0.03, 0.2}, g);
  for (int k = 0; k < 1000; ++k) gait.advance(0.01, {}, g);
  EXPECT_EQ(gait.phase(), Gait::standing);
  const Foothold l = gait.sole(left_side, g).at, r = gait.sole(right_side, g).at;
  EXPECT_NEAR(std::hypot(l.x - r.x, l.y - r.y), 0.086, 2e-3);
  EXPECT_NEAR(l.yaw, r.yaw, 1e-9);
  EXPECT_NEAR(gait.along_x().position, 0.5 * (l.x + r.x), 1e-6);
  EXPECT_NEAR(gait.along_y().position, 0.5 * (l.y + r.y), 1e-6);
  EXPECT_NEAR(gait.along_y().velocity, 0, 1e-6);
}

TEST(Gait, TheSwingFootFollowsTheCapturePoint) {
  const GaitSettings g = settings_of(short_steps);
  Gait gait;
  gait.stand({}, g);
  for (int k = 0; k < 1000; ++k) gait.advance(0.01, {0.1, 0, 0}, g);
  run_to_switch(gait, 0.01, {0.1, 0, 0}, g);
  for (int k = 0; k < 10; ++k) gait.advance(0.01, {0.1, 0, 0}, g);
  const double before = gait.target().x;
  gait.find_astray(0.01, g);
  gait.advance(0.01, {0.1, 0, 0}, g);
  EXPECT_NEAR(gait.target().x - before, 0.01 * std::exp(g.w() * 0.2), 1e-9) << "0.2 s before it comes down";
  // this step compensates what the pendulum has lost, and the walk goes on as before
  run_to_switch(gait, 0.01, {0.1, 0, 0}, g);
  const double first = gait.sole(gait.stance(), g).at.x;
  run_to_switch(gait, 0.01, {0.1, 0, 0}, g);
  EXPECT_NEAR(gait.sole(gait.stance(), g).at.x - first, 0.03, 1e-6);
}

}  // namespace
}  // namespace muro::walk_test
