// SPDX-License-Identifier: MIT
#include "rigid_body.hpp"

#include <gtest/gtest.h>

#include "muro/geometry.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::simplified {
namespace {

using namespace integrator;

// The free box of S. Peters and J. Hsu, Comparison of Rigid Body Dynamic Simulators for Robotic Simulation in Gazebo.
constexpr double box_mass = 10;
const Vec3 moments(0.80833333333333333, 0.68333333333333333, 0.14166666666666667);
const Vec3 box_gravity(0, 0, -9.8);

V3<double> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
M3<double> plain(const Mat3& m) { return {plain(Vec3(m.col(0))), plain(Vec3(m.col(1))), plain(Vec3(m.col(2)))}; }
Vec3 vector(const V3<double>& v) { return {v.x, v.y, v.z}; }

/// A body for the integrator, with vectors of Eigen.
struct Body {
  Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
  Quat orientation = Quat::Identity();
  Vec3 spin = Vec3::Zero();

  template <class Advance>
  void with(Advance advance) {
    const Quat& q = orientation;
    RigidBody<double> b{plain(centre), plain(velocity), {q.x(), q.y(), q.z(), q.w()}, plain(spin)};
    advance(b);
    centre = vector(b.centre);
    velocity = vector(b.velocity);
    orientation = Quat(b.orientation.w, b.orientation.x, b.orientation.y, b.orientation.z);
    spin = vector(b.spin);
  }
};
void advance_rotation(Body& body, const Mat3& r, const Mat3& inertia, const Mat3& half, const Mat3& end,
                      const Vec3& torque, double dt) {
  body.with([&](RigidBody<double>& b) {
    integrator::advance_rotation(b, plain(r), plain(inertia), plain(half), plain(end), plain(torque), dt);
  });
}
void advance_centre(Body& body, const Vec3& acceleration, double dt) {
  body.with([&](RigidBody<double>& b) { integrator::advance_centre(b, plain(acceleration), dt); });
}

struct FreeBox {
  Body body;
  Mat3 inertia = moments.asDiagonal(), inverse = moments.cwiseInverse().asDiagonal();
  Vec3 acceleration = Vec3::Zero();

  void step(double dt) {
    advance_centre(body, acceleration, dt);
    advance_rotation(body, body.orientation.toRotationMatrix(), inertia, inverse, inverse, Vec3::Zero(), dt);
  }
  Vec3 body_rates() const { return body.orientation.conjugate() * body.spin; }
  Vec3 momentum() const { return body.orientation * Vec3(inertia * body_rates()); }
  double energy() const {
    return 0.5 * box_mass * body.velocity.squaredNorm() + 0.5 * body_rates().dot(inertia * body_rates()) -
           box_mass * acceleration.dot(body.centre);
  }
};

FreeBox complex_box() {
  FreeBox box;
  box.body.velocity = {-2, 2, 8};
  box.body.spin = {0.1, 5.0, 0.1};
  box.acceleration = box_gravity;
  return box;
}

Vec3 rates_at(double time, double dt) {
  FreeBox box = complex_box();
  const long steps = std::lround(time / dt);
  for (long k = 0; k < steps; ++k) box.step(dt);
  return box.body_rates();
}

TEST(RigidBody, ASteadySpinAboutAPrincipalAxisIsExact) {
  FreeBox box;
  box.body.velocity = {-0.9, 0.4, 0.1};
  box.body.spin = {0.5, 0, 0};
  EXPECT_NEAR(box.energy(), 5.001041625, 1e-7);
  EXPECT_NEAR(box.momentum().norm(), 0.404166, 1e-6);
  for (int k = 0; k < 10000; ++k) box.step(0.001);
  EXPECT_LT((box.body.centre - 10 * Vec3(-0.9, 0.4, 0.1)).norm(), 1e-10);
  EXPECT_LT(Eigen::AngleAxisd(box.body.orientation * rotation_of(Vec3(5, 0, 0)).conjugate()).angle(), 1e-9);
  EXPECT_NEAR(box.energy(), 5.001041625, 1e-7);
}

TEST(RigidBody, ATumblingBoxInFlightBeatsThePublishedErrorsOfGeneralEngines) {
  // At 1 ms over 10 s the best published engine (Simbody) has 0.0064, 0.0062 and 0.0245 m.
  FreeBox box = complex_box();
  const double energy = box.energy();
  const Vec3 momentum = box.momentum();
  EXPECT_NEAR(energy, 368.5464125, 1e-5);
  EXPECT_NEAR(momentum.norm(), 3.41765, 1e-5);
  double momentum_error = 0, energy_error = 0, position_error = 0;
  for (int k = 1; k <= 10000; ++k) {
    box.step(0.001);
    const double t = 0.001 * k;
    momentum_error = std::max(momentum_error, (box.momentum() - momentum).norm() / momentum.norm());
    energy_error = std::max(energy_error, std::abs(box.energy() - energy) / energy);
    position_error =
        std::max(position_error, (box.body.centre - Vec3(-2, 2, 8) * t - 0.5 * box_gravity * t * t).norm());
  }
  EXPECT_LT(momentum_error, 1e-11);  // round-off of 10000 steps
  EXPECT_LT(energy_error, 1e-6);     // second order: (w dt)^2 = 2.5e-5, of the rotational part (2 %) of the energy
  EXPECT_LT(position_error, 1e-9);   // the parabola is exact
}

TEST(RigidBody, ATumblingBoxHasTheRatesOfTheClosedForm) {
  // Jacobi elliptic functions; values from the benchmark's own solution.
  const Vec3 at_1(3.423798442, 2.819185438, 3.928384449), at_10(2.755840405, -3.735963519, -3.161809003);
  EXPECT_LT((rates_at(1, 1e-3) - at_1).norm(), 1e-3);
  EXPECT_LT((rates_at(10, 1e-3) - at_10).norm(), 5e-2);
  EXPECT_LT((rates_at(10, 1e-4) - at_10).norm(), 5e-4);
  EXPECT_LT((rates_at(1, 1e-5) - at_1).norm(), 1e-7);
}

TEST(RigidBody, TheAttitudeIsOfSecondOrder) {
  const Vec3 truth(3.423798442, 2.819185438, 3.928384449);
  const double coarse = (rates_at(1, 4e-3) - truth).norm(), fine = (rates_at(1, 2e-3) - truth).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

TEST(RigidBody, ASymmetricBodyPrecessesAtTheRateOfEuler) {
  // Torque-free: the axis turns about L at |L| / I1.
  const double i1 = 0.0125, i3 = 0.005;
  const Mat3 inertia = Vec3(i1, i1, i3).asDiagonal(), inverse = inertia.inverse();
  Body body;
  body.spin = {3, 0, 200};
  const Vec3 momentum = inertia * body.spin;
  const double dt = 1e-4, rate = momentum.norm() / i1;
  const int steps = 2000;
  for (int k = 0; k < steps; ++k)
    advance_rotation(body, body.orientation.toRotationMatrix(), inertia, inverse, inverse, Vec3::Zero(), dt);
  const Vec3 expected = rotation_of(Vec3(momentum.normalized() * (rate * dt * steps))) * Vec3::UnitZ();
  const Vec3 axis = body.orientation * Vec3::UnitZ();
  EXPECT_LT(std::acos(std::min(1.0, axis.dot(expected))), 2e-4);
  EXPECT_NEAR(axis.dot(momentum.normalized()), momentum.normalized().z(), 1e-7);
}

TEST(RigidBody, AGyroscopeUnderGravityPrecessesSteadily) {
  // A disc (m = 1, r = 0.1) on an arm l = 0.1, held at the pivot, axis horizontal: m g l / (I3 s) = 0.981 rad/s
  // exactly. The constraint is the torque of gravity about the pivot, so the tensor is taken about the pivot.
  const double i1 = 0.0125, i3 = 0.005, spin = 200, rate = 0.981, dt = 1e-4;
  const Mat3 inertia = Vec3(i1, i1, i3).asDiagonal(), inverse = inertia.inverse();
  Body body;
  body.orientation = rotation_of(Vec3(0, M_PI / 2, 0));  // the axis (z of the body) along x of the world
  body.spin = {spin, 0, rate};
  for (int k = 0; k < 10000; ++k) {
    const Vec3 arm = body.orientation * Vec3(0, 0, 0.1);
    advance_rotation(body, body.orientation.toRotationMatrix(), inertia, inverse, inverse, arm.cross(Vec3(0, 0, -9.81)),
                     dt);
  }
  const Vec3 axis = body.orientation * Vec3::UnitZ();
  EXPECT_NEAR(std::atan2(axis.y(), axis.x()), rate * 1.0, 1e-3);
  EXPECT_NEAR(axis.z(), 0, 1e-3);
}

TEST(RigidBody, AConstantForceHasNoPositionError) {
  // Semi-implicit Euler would be wrong by g dt t / 2 = 0.49 m here.
  Body body;
  for (int k = 0; k < 1000; ++k) advance_centre(body, {0, 0, -9.81}, 0.01);
  EXPECT_NEAR(body.centre.z(), -0.5 * 9.81 * 100, 1e-9);
  EXPECT_NEAR(body.velocity.z(), -98.1, 1e-10);
}

TEST(RigidBody, TheQuaternionKeepsItsLengthForEver) {
  FreeBox box = complex_box();
  for (int k = 0; k < 200000; ++k) box.step(0.01);
  EXPECT_NEAR(box.body.orientation.norm(), 1, 1e-14);
}

}  // namespace
}  // namespace muro::simplified
