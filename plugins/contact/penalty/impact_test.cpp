// SPDX-License-Identifier: MIT
// Impacts against their closed forms: Newton's restitution, Coulomb's friction, at the time of impact.
#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "muro/toolkit/rotations.hpp"
#include "penalty_testing.hpp"

namespace muro {
namespace {

using namespace test;

/// Lets a ball fall from `height` (m) and bounce on the ground. Compares the time and the height of each bounce, which
/// follow from its free flight, with the geometric series.
void expect_series(double height, double restitution, double rate) {
  ContactScene s;
  s.add_ground(0.5);
  const RobotView& r = s.add("ball", ball(2, 0.1, 0.5, restitution), {{0, 0, 0.1 + height}, Quat::Identity()});
  s.start(rate);
  double speed = std::sqrt(2 * g * height), impact = speed / g;
  for (int bounce = 1; bounce <= 25 && speed * restitution > 0.15; ++bounce) {
    speed *= restitution;
    const double top = impact + speed / g;
    s.run_for(std::ceil(top * rate) / rate - 1e-9 * double(s.now()));
    const double v = s.twist(r).linear.z(), z = s.pose(r).position.z() - 0.1, now = 1e-9 * double(s.now());
    EXPECT_NEAR(z + v * v / (2 * g), speed * speed / (2 * g), 1e-9 * height)
        << "bounce " << bounce << " of " << height << " m, e " << restitution << " at " << rate << " Hz";
    EXPECT_NEAR(now - (speed - v) / g, impact, 1e-9)
        << "bounce " << bounce << " of " << height << " m, e " << restitution << " at " << rate << " Hz";
    impact += 2 * speed / g;
  }
}

TEST(Impacts, ABouncingBallKeepsToItsGeometricSeries) {
  for (const double rate : {250.0, 1000.0, 4000.0})
    for (const double height : {0.05, 1.0, 30.0})
      for (const double restitution : {1.0, 0.9, 0.7, 0.3}) expect_series(height, restitution, rate);
}

TEST(Impacts, OfPlasticBodiesLeaveNoSpeed) {
  ContactScene s;
  s.add_ground(0.5);
  const RobotView& r = s.add("ball", ball(1, 0.1, 0.5, 0), {{0, 0, 1.1}, Quat::Identity()});
  s.start();
  double highest = -1;
  while (s.now() < 1'000'000'000) {
    s.run_for(0.001);
    if (s.now() > 460'000'000) highest = std::max(highest, s.twist(r).linear.z());
  }
  EXPECT_LT(highest, 0.002);
  EXPECT_NEAR(s.pose(r).position.z(), 0.1, 2e-4);
}

TEST(Impacts, ObliqueOnesSlipOrStickAsCoulombSays) {
  // A solid ball: the slip of its lowest point changes by at most mu (1 + e) v (1 + 5/2); what sticks rolls at 5/7.
  const double e = 0.8, v = std::sqrt(2 * g * 0.5);
  for (const double mu : {0.05, 0.8}) {
    ContactScene s;
    s.add_ground(mu);
    const RobotView& r = s.add("ball", ball(1, 0.1, mu, e), {{0, 0, 0.6}, Quat::Identity()}, {{2, 1, 0}, Vec3::Zero()});
    s.start();
    s.run_for(0.4);
    const Vec3 along = Vec3(2, 1, 0).normalized(), linear = s.twist(r).linear, angular = s.twist(r).angular;
    const double before = std::sqrt(5.0), change = std::min(mu * (1 + e) * v, before * 2 / 7);
    EXPECT_NEAR(linear.dot(along), before - change, 1e-9) << mu;
    EXPECT_NEAR(angular.dot(Vec3::UnitZ().cross(along)), change * 2.5 / 0.1, 1e-6) << mu;
    EXPECT_NEAR(linear.x() * along.y() - linear.y() * along.x(), 0, 1e-9) << mu;
    EXPECT_NEAR(linear.z(), e * v - g * (0.4 - v / g), 1e-9) << mu;
  }
}

TEST(Impacts, OfARodsEndThatSlidesAndThenSticksFollowRouthsPath) {
  // In the plane: change of velocity by an impulse (p, 1) at the end. First p = mu, against the slip; then p keeps the
  // end from slipping, or is mu the other way.
  constexpr double length = 1, e = 0.5, angle = 0.6, inertia = 1.0 / 12, sideways = 0.8;
  constexpr double radius = 1e-3, fall = 1;
  const double x = 0.5 * length * std::cos(angle), z = -0.5 * length * std::sin(angle) - radius;
  const double kxx = 1 + z * z / inertia, kxz = -x * z / inertia, kzz = 1 + x * x / inertia;
  for (const double mu : {0.05, 0.5, 1.0}) {
    ContactScene s;
    s.add_ground(mu);
    Shape shape = Shape::capsule(radius, length);
    shape.surface = {.friction = mu, .restitution = e};
    shape.origin.orientation = from_rpy(0, M_PI / 2, 0);
    const RobotView& r = s.add("rod", single_body(shape, {.mass = 1, .ixx = 1e-3, .iyy = inertia, .izz = inertia}),
                               {{0, 0, fall - z}, from_rpy(0, angle, 0)}, {{-sideways, 0, 0}, Vec3::Zero()});
    s.start();
    const double v = std::sqrt(2 * g * fall);
    s.run_for(v / g + 2e-3);
    double px = 0, pz = 0, slip = -sideways, rises = -v;
    const auto push = [&](double p, double part) {
      px += p * part, pz += part;
      slip += (kxx * p + kxz) * part, rises += (kxz * p + kzz) * part;
    };
    const double against = mu, until_stop = -slip / (kxx * against + kxz),
                 until_end = (e * v - rises) / (kzz + kxz * mu);
    push(against, std::min(until_stop, until_end));
    const double sticks = -std::min(mu, kxz / kxx);
    push(sticks, (e * v - rises) / (kzz + kxz * sticks));
    EXPECT_NEAR(s.twist(r).linear.x(), -sideways + px, 1e-9) << mu;
    EXPECT_NEAR(s.twist(r).angular.y(), (z * px - x * pz) / inertia, 1e-9) << mu;
  }
}

TEST(Impacts, OfTwoBallsExchangeMomentumAsNewtonSays) {
  for (const double e : {1.0, 0.5, 0.0}) {
    ContactScene s;
    s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    const RobotView& a = s.add("a", ball(1, 0.1, 0, e), {{0, 0, 0}, Quat::Identity()}, {{2, 0, 0}, Vec3::Zero()});
    const RobotView& b = s.add("b", ball(3, 0.1, 0, e), {{1, 0, 0}, Quat::Identity()}, {{-1, 0, 0}, Vec3::Zero()});
    s.start();
    s.run_for(1);
    const double common = (2 - 3) / 4.0, impact = 0.8 / 3;
    const double of_a = common - e * 3.0 / 4 * 3, of_b = common + e * 1.0 / 4 * 3;
    EXPECT_NEAR(s.twist(a).linear.x(), of_a, 1e-9) << e;
    EXPECT_NEAR(s.twist(b).linear.x(), of_b, 1e-9) << e;
    EXPECT_NEAR(s.pose(a).position.x(), 2 * impact + of_a * (1 - impact), 1e-9) << e;
    EXPECT_NEAR(s.pose(b).position.x(), 1 - impact + of_b * (1 - impact), 1e-9) << e;
  }
}

TEST(Impacts, AFlatLandingReboundsWithItsRestitutionAndDoesNotTurn) {
  ContactScene s;
  s.add_ground(0.5);
  const RobotView& r = s.add("box", block(3, {0.4, 0.3, 0.2}, 0.5, 0.6), {{0, 0, 0.6}, Quat::Identity()});
  s.start();
  s.run_for(0.5);
  const double fall = std::sqrt(2 * g * 0.5);
  EXPECT_NEAR(s.twist(r).linear.z(), 0.6 * fall - g * (0.5 - fall / g), 1e-9);
  EXPECT_LT(s.twist(r).angular.norm(), 1e-9);
}

TEST(Impacts, OfATumblingElasticBoxNearlyKeepItsEnergy) {
  // The box is among six walls. Springs act on points that touch while a face swings to a wall; they give it some
  // energy.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 12; ++trial) {
    ContactScene s;
    s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    const double friction = trial % 2 == 0 ? 0 : 0.6;
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0})
        s.add_box("wall" + std::to_string(k) + (side < 0 ? "a" : "b"), 1.5 * side * Vec3::Unit(k),
                  Vec3(4, 4, 4) - 2 * Vec3::Unit(k), friction);
    const Vec3 size(0.3, 0.2, 0.25), spin(6 * unit(random), 6 * unit(random), 6 * unit(random));
    const RobotView& r = s.add("box", block(2, size, friction, 1), {{0, 0, 0}, from_rpy(unit(random), unit(random), 0)},
                               {{3 * unit(random), 3 * unit(random), 3}, spin});
    s.start();
    const Mat3 inertia = solid_box(2, size).tensor();
    const auto energy = [&] {
      const Vec3 w = s.pose(r).orientation.conjugate() * s.twist(r).angular;
      return s.twist(r).linear.squaredNorm() + 0.5 * w.dot(inertia * w);
    };
    const double start = energy();
    for (int k = 0; k < 40; ++k) {
      s.run_for(0.1);
      EXPECT_LE(energy(), start * 1.1) << trial;
    }
    if (friction == 0) {
      EXPECT_GT(energy(), 0.5 * start) << trial;
    }
  }
}

}  // namespace
}  // namespace muro
