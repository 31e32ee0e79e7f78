// SPDX-License-Identifier: MIT
#include "rolling.hpp"

#include <gtest/gtest.h>

#include <random>

#include "gauss.hpp"
#include "omni.hpp"

namespace muro::wheeled {
namespace {

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

template <int N>
void expect_exact(const Gauss<N>& rule) {
  for (int degree = 0; degree < 2 * N; ++degree) {
    double whole = 0;
    for (int j = 0; j < N; ++j) whole += rule.weight[j] * std::pow(rule.at[j], degree);
    EXPECT_NEAR(whole, 1.0 / (degree + 1), 1e-15);
    for (int i = 0; i < N && degree < N; ++i) {
      double part = 0;
      for (int j = 0; j < N; ++j) part += rule.until[i][j] * std::pow(rule.at[j], degree);
      EXPECT_NEAR(part, std::pow(rule.at[i], degree + 1) / (degree + 1), 1e-15);
    }
  }
}

TEST(Gauss, IntegratesPolynomialsOfTwiceAsManyTermsAsPointsAndToEachPointThoseOfAsMany) {
  expect_exact(gauss_2);
  expect_exact(gauss_5);
}

SteeredWheel steered(const Vec3& pivot, const Vec3& centre, const Vec3& axis = Vec3::UnitY()) {
  SteeredWheel w;
  w.centre = centre, w.pivot = pivot, w.axis = axis, w.radius = 0.1, w.steering = 1;
  return w;
}

TEST(PlanarWheel, MovesAsItsCentreOnAnArmThatTurns) {
  Draw draw{std::mt19937(1)};
  for (int round = 0; round < 50; ++round) {
    const Vec3 pivot(draw(-2, 2), draw(-2, 2), 0), arm(draw(-0.3, 0.3), draw(-0.3, 0.3), 0);
    const double yaw = draw(-1.5, 1.5), side = round % 2 == 0 ? 1 : -1;
    const PlanarWheel w(steered(pivot, pivot + arm, side * Vec3(-std::sin(yaw), std::cos(yaw), 0)));
    EXPECT_NEAR(w.straight, yaw, 1e-15);
    EXPECT_NEAR(w.per_metre, side / 0.1, 1e-12);
    const double angle = draw(-2, 2), rate = draw(-3, 3);
    const PlanarTwist v{draw(-2, 2), draw(-2, 2), draw(-2, 2)};
    const Vec3 turned = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * arm;
    const Vec3 moving = Vec3(v.x, v.y, 0) + Vec3(0, 0, v.turn).cross(pivot) + Vec3(0, 0, v.turn + rate).cross(turned);
    const double heading = w.straight + angle, s = std::sin(heading), c = std::cos(heading);
    EXPECT_NEAR(w.along(s, c, v, rate), moving.dot(Vec3(c, s, 0)), 1e-14);
    EXPECT_NEAR(w.across(s, c, v, rate), moving.dot(Vec3(-s, c, 0)), 1e-14);
  }
}

/// Wheels at given headings, the first `driven` of them driven.
struct Vehicle {
  std::vector<PlanarWheel> wheels;
  std::vector<Rolling> rolling;
  std::size_t driven = 1;

  void add(double x, double y, double heading, double speed = 0) {
    wheels.emplace_back(steered({x, y, 0}, {x, y, 0}));
    rolling.push_back({std::sin(heading), std::cos(heading), 0, speed});
  }
  Allowed velocity() const {
    return RollingBase(wheels).velocity(
        wheels.size(), [&](std::size_t i) { return wheels[i]; }, [&](std::size_t i) { return rolling[i]; },
        [&](std::size_t i) { return i < driven; });
  }
  /// Sum of squares of the velocities across, for a motion of size 1.
  double slip(const PlanarTwist& v) const {
    double x = 0, y = 0, spread = 0, sum = 0;
    for (const PlanarWheel& w : wheels) x += w.x / double(wheels.size()), y += w.y / double(wheels.size());
    for (const PlanarWheel& w : wheels) spread += (w.x - x) * (w.x - x) + (w.y - y) * (w.y - y);
    for (std::size_t i = 0; i < wheels.size(); ++i)
      sum += std::pow(wheels[i].across(rolling[i].sine, rolling[i].cosine, v, 0), 2);
    return sum / (std::pow(v.x - v.turn * y, 2) + std::pow(v.y + v.turn * x, 2) +
                  v.turn * v.turn * spread / double(wheels.size()));
  }
};

TEST(RollingBase, TurnsAboutThePointToWhichAllAxlesPoint) {
  Draw draw{std::mt19937(2)};
  for (int round = 0; round < 100; ++round) {
    const double cx = draw(-5, 5), cy = draw(-5, 5), turn = draw(0.1, 2);
    Vehicle vehicle;
    for (int i = 0; i < 2 + round % 4; ++i) {
      const double x = draw(-1, 1), y = draw(-1, 1), heading = std::atan2(x - cx, cy - y);
      vehicle.add(x, y, heading, turn * ((cy - y) * std::cos(heading) + (x - cx) * std::sin(heading)));
    }
    vehicle.driven = 1 + std::size_t(round) % vehicle.wheels.size();
    const Allowed v = vehicle.velocity();
    EXPECT_TRUE(v.one_way);
    EXPECT_NEAR(v.velocity.turn, turn, 1e-12);
    EXPECT_NEAR(v.velocity.x, turn * cy, 1e-12);
    EXPECT_NEAR(v.velocity.y, -turn * cx, 1e-12);
  }
}

TEST(RollingBase, SlipsLeastWhenAxlesDoNotMeet) {
  Draw draw{std::mt19937(3)};
  for (int round = 0; round < 30; ++round) {
    Vehicle vehicle;
    vehicle.add(0, 0.5, 0, 1);
    vehicle.add(0, -0.5, 0, 1);
    vehicle.add(2, 0.5, draw(-1, 1));
    vehicle.add(2, -0.5, draw(-1, 1));
    vehicle.driven = 2;
    const PlanarTwist v = vehicle.velocity().velocity;
    const double least = vehicle.slip(v);
    for (int i = 0; i < 200; ++i)
      EXPECT_LE(least, vehicle.slip(v + PlanarTwist{draw(-1, 1), draw(-1, 1), draw(-1, 1)} * draw(0, 0.3)) + 1e-15);
    double along = 0;
    for (int i : {0, 1}) along += 0.5 * vehicle.wheels[std::size_t(i)].along(0, 1, v, 0);
    EXPECT_GT(along, 0.8) << "forward, as its driven wheels turn";
    EXPECT_LE(along, 1.0001);
  }
}

TEST(RollingBase, IsLeftToItsDrivenWheelsWhereAllAxlesAreOne) {
  Vehicle vehicle;
  vehicle.add(0.1, 0.5, 0, 1);
  vehicle.add(0.1, -0.5, 0, 3);
  vehicle.driven = 2;
  const Allowed v = vehicle.velocity();
  EXPECT_FALSE(v.one_way);
  EXPECT_NEAR(v.velocity.x, 2, 1e-14);
  EXPECT_NEAR(v.velocity.turn, 2, 1e-14);
  EXPECT_NEAR(v.velocity.y, -0.2, 1e-14) << "the axle, not the base, moves straight ahead";
  vehicle.driven = 1;
  const PlanarTwist least = vehicle.velocity().velocity;
  EXPECT_NEAR(vehicle.wheels[0].along(0, 1, least, 0), 1, 1e-14);
}

TEST(RollingBase, StandsWhenItsDrivenWheelIsInTheCentreOfRotation) {
  Vehicle vehicle;
  vehicle.add(0, 0, 0.3, 1);
  vehicle.add(1, 0, 0);
  vehicle.add(0, 1, M_PI / 2);
  const PlanarTwist v = vehicle.velocity().velocity;
  EXPECT_LT(std::abs(v.x) + std::abs(v.y) + std::abs(v.turn), 10)
      << "a finite motion, however little it has to do with the drive";
}

TEST(OmniWheels, FollowTheEquationOfTheSwedishWheel) {
  Draw draw{std::mt19937(4)};
  for (int round = 0; round < 50; ++round) {
    const double l = draw(0.1, 2), alpha = draw(-3, 3), beta = draw(-3, 3), gamma = draw(-1.2, 1.2),
                 r = draw(0.02, 0.3);
    OmniWheel w;
    w.centre = {l * std::cos(alpha), l * std::sin(alpha), draw(-1, 1)};
    w.axis = {std::cos(alpha + beta), std::sin(alpha + beta), 0};
    w.heading = w.axis.cross(Vec3::UnitZ());
    w.radius = r, w.roller_angle = gamma;
    const PlanarTwist asks = asks_of(w);
    const double k = 1 / (r * std::cos(gamma));
    EXPECT_NEAR(asks.x, k * std::sin(alpha + beta + gamma), 1e-12);
    EXPECT_NEAR(asks.y, -k * std::cos(alpha + beta + gamma), 1e-12);
    EXPECT_NEAR(asks.turn, -k * l * std::cos(beta + gamma), 1e-12);
  }
}

TEST(OmniWheels, SharesAreTheInverseOfWhatTheyAsk) {
  Draw draw{std::mt19937(5)};
  for (std::size_t count = 3; count < 8; ++count) {
    std::vector<OmniWheel> wheels(count);
    for (OmniWheel& w : wheels) {
      const double yaw = draw(-3, 3);
      w.centre = {draw(-1, 1), draw(-1, 1), 0}, w.radius = draw(0.05, 0.1), w.roller_angle = draw(-1, 1);
      w.heading = {std::cos(yaw), std::sin(yaw), 0};
    }
    const std::vector<PlanarTwist> shares = shares_of(RobotView{}, wheels);
    const PlanarTwist v{draw(-1, 1), draw(-1, 1), draw(-1, 1)};
    PlanarTwist sum;
    for (std::size_t i = 0; i < count; ++i) {
      const PlanarTwist a = asks_of(wheels[i]);
      sum = sum + shares[i] * (a.x * v.x + a.y * v.y + a.turn * v.turn);
    }
    EXPECT_NEAR(sum.x, v.x, 1e-12);
    EXPECT_NEAR(sum.y, v.y, 1e-12);
    EXPECT_NEAR(sum.turn, v.turn, 1e-12);
  }
}

}  // namespace
}  // namespace muro::wheeled
