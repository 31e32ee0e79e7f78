// SPDX-License-Identifier: MIT
#include "rolling_constraints.hpp"

#include <gtest/gtest.h>

#include "gauss_collocation.hpp"
#include "tests/support/randoms.hpp"

namespace muro::wheels {
namespace {

template <int N>
void expect_exact(const GaussCollocation<N>& rule) {
  for (int degree = 0; degree < 2 * N; ++degree) {
    double integral = 0;
    for (int j = 0; j < N; ++j) integral += rule.weight[j] * std::pow(rule.node[j], degree);
    EXPECT_NEAR(integral, 1.0 / (degree + 1), 1e-15);
    for (int i = 0; i < N && degree < N; ++i) {
      double until_node = 0;
      for (int j = 0; j < N; ++j) until_node += rule.matrix[i][j] * std::pow(rule.node[j], degree);
      EXPECT_NEAR(until_node, std::pow(rule.node[i], degree + 1) / (degree + 1), 1e-15);
    }
  }
}

TEST(GaussCollocation, IsExactForPolynomialsUpToItsOrder) {
  expect_exact(gauss_2);
  expect_exact(gauss_5);
}

SteeredWheel steered(const Vec3& pivot, const Vec3& centre, const Vec3& axis = Vec3::UnitY()) {
  SteeredWheel w;
  w.centre = centre, w.pivot = pivot, w.axis = axis, w.radius = 0.1, w.steering = 1;
  return w;
}

TEST(PlanarWheel, MovesAsItsCentreOnAnArmThatTurns) {
  test::Randoms draw(1);
  for (int round = 0; round < 50; ++round) {
    const Vec3 pivot(draw.uniform(-2, 2), draw.uniform(-2, 2), 0),
        arm(draw.uniform(-0.3, 0.3), draw.uniform(-0.3, 0.3), 0);
    const double yaw = draw.uniform(-1.5, 1.5), side = round % 2 == 0 ? 1 : -1;
    const PlanarWheel w(steered(pivot, pivot + arm, side * Vec3(-std::sin(yaw), std::cos(yaw), 0)));
    EXPECT_NEAR(w.zero_heading, yaw, 1e-15);
    EXPECT_NEAR(w.angle_per_metre, side / 0.1, 1e-12);
    const double angle = draw.uniform(-2, 2), rate = draw.uniform(-3, 3);
    const PlanarTwist v{draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-2, 2)};
    const Vec3 turned = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * arm;
    const Vec3 moving =
        Vec3(v.x, v.y, 0) + Vec3(0, 0, v.yaw_rate).cross(pivot) + Vec3(0, 0, v.yaw_rate + rate).cross(turned);
    const double heading = w.zero_heading + angle, s = std::sin(heading), c = std::cos(heading);
    EXPECT_NEAR(w.longitudinal_velocity(s, c, v, rate), moving.dot(Vec3(c, s, 0)), 1e-14);
    EXPECT_NEAR(w.lateral_velocity(s, c, v, rate), moving.dot(Vec3(-s, c, 0)), 1e-14);
  }
}

/// Wheels at given headings; the first `driven` of them are driven.
struct Vehicle {
  std::vector<PlanarWheel> wheels;
  std::vector<WheelState> states;
  std::size_t driven = 1;

  void add(double x, double y, double heading, double speed = 0) {
    wheels.emplace_back(steered({x, y, 0}, {x, y, 0}));
    states.push_back({std::sin(heading), std::cos(heading), 0, speed});
  }
  RollingMotion motion() const {
    return RollingConstraints(wheels).motion(
        wheels.size(), [&](std::size_t i) { return wheels[i]; }, [&](std::size_t i) { return states[i]; },
        [&](std::size_t i) { return i < driven; });
  }
  /// Returns the sum of squares of the lateral velocities, for a motion of size 1.
  double slip(const PlanarTwist& v) const {
    double x = 0, y = 0, spread = 0, sum = 0;
    for (const PlanarWheel& w : wheels) x += w.x / double(wheels.size()), y += w.y / double(wheels.size());
    for (const PlanarWheel& w : wheels) spread += (w.x - x) * (w.x - x) + (w.y - y) * (w.y - y);
    for (std::size_t i = 0; i < wheels.size(); ++i)
      sum += std::pow(wheels[i].lateral_velocity(states[i].sine, states[i].cosine, v, 0), 2);
    return sum / (std::pow(v.x - v.yaw_rate * y, 2) + std::pow(v.y + v.yaw_rate * x, 2) +
                  v.yaw_rate * v.yaw_rate * spread / double(wheels.size()));
  }
};

TEST(RollingConstraints, TurnsAboutThePointToWhichAllAxlesPoint) {
  test::Randoms draw(2);
  for (int round = 0; round < 100; ++round) {
    const double cx = draw.uniform(-5, 5), cy = draw.uniform(-5, 5), turn = draw.uniform(0.1, 2);
    Vehicle vehicle;
    for (int i = 0; i < 2 + round % 4; ++i) {
      const double x = draw.uniform(-1, 1), y = draw.uniform(-1, 1), heading = std::atan2(x - cx, cy - y);
      vehicle.add(x, y, heading, turn * ((cy - y) * std::cos(heading) + (x - cx) * std::sin(heading)));
    }
    vehicle.driven = 1 + std::size_t(round) % vehicle.wheels.size();
    const RollingMotion v = vehicle.motion();
    EXPECT_EQ(v.degree_of_mobility, 1);
    EXPECT_NEAR(v.velocity.yaw_rate, turn, 1e-12);
    EXPECT_NEAR(v.velocity.x, turn * cy, 1e-12);
    EXPECT_NEAR(v.velocity.y, -turn * cx, 1e-12);
  }
}

TEST(RollingConstraints, SlipsLeastWhenAxlesDoNotMeet) {
  test::Randoms draw(3);
  for (int round = 0; round < 30; ++round) {
    Vehicle vehicle;
    vehicle.add(0, 0.5, 0, 1);
    vehicle.add(0, -0.5, 0, 1);
    vehicle.add(2, 0.5, draw.uniform(-0.5, 0.5));
    vehicle.add(2, -0.5, draw.uniform(-0.5, 0.5));
    vehicle.driven = 2;
    const PlanarTwist v = vehicle.motion().velocity;
    const double smallest = vehicle.slip(v);
    for (int i = 0; i < 200; ++i)
      EXPECT_LE(smallest, vehicle.slip(v + PlanarTwist{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)} *
                                               draw.uniform(0, 0.3)) +
                              1e-15);
    double along = 0;
    for (int i : {0, 1}) along += 0.5 * vehicle.wheels[std::size_t(i)].longitudinal_velocity(0, 1, v, 0);
    EXPECT_GT(along, 0.8) << "forward, as its driven wheels turn";
    EXPECT_LE(along, 1.0001);
  }
}

TEST(RollingConstraints, IsLeftToItsDrivenWheelsWhereAllAxlesAreOne) {
  Vehicle vehicle;
  vehicle.add(0.1, 0.5, 0, 1);
  vehicle.add(0.1, -0.5, 0, 3);
  vehicle.driven = 2;
  const RollingMotion v = vehicle.motion();
  EXPECT_EQ(v.degree_of_mobility, 2);
  EXPECT_NEAR(v.velocity.x, 2, 1e-14);
  EXPECT_NEAR(v.velocity.yaw_rate, 2, 1e-14);
  EXPECT_NEAR(v.velocity.y, -0.2, 1e-14) << "the axle, not the base, moves straight ahead";
  vehicle.driven = 1;
  const PlanarTwist by_one_wheel = vehicle.motion().velocity;
  EXPECT_NEAR(vehicle.wheels[0].longitudinal_velocity(0, 1, by_one_wheel, 0), 1, 1e-14);
}

TEST(RollingConstraints, StandsWhenItsDrivenWheelIsInTheCentreOfRotation) {
  Vehicle vehicle;
  vehicle.add(0, 0, 0.3, 1);
  vehicle.add(1, 0, 0);
  vehicle.add(0, 1, M_PI / 2);
  const PlanarTwist v = vehicle.motion().velocity;
  EXPECT_LT(std::abs(v.x) + std::abs(v.y) + std::abs(v.yaw_rate), 10)
      << "a finite motion, however little it has to do with the drive";
}

}  // namespace
}  // namespace muro::wheels
