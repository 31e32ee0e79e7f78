// SPDX-License-Identifier: MIT
// Bodies that bounce and rest.
#include <random>

#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

/// Returns the largest error of the times of the first three impacts of a ball of restitution 0.7 dropped from 1 m.
Outcome bounces(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  const double radius = 0.05;
  const RobotView& r = t.add("ball", ball(1, radius, 0.5, 0.7), {{0, 0, 1 + radius}, Quat::Identity()});
  t.start();
  constexpr double expected[] = {0.451524, 1.083657, 1.526150};
  double worst = 0;
  std::string seen;
  int impacts = 0;
  for (double before = 0; impacts < 3 && t.now() < 3'000'000'000;) {
    t.run_for(0.001);
    const double v = t.twist(r).linear.z();
    if (before < -0.1 && v >= 0) {
      const double time = 1e-9 * double(t.now());
      worst = std::max(worst, std::abs(time - expected[impacts++]));
      seen += (seen.empty() ? "" : " ") + text(time);
    }
    before = v;
  }
  if (impacts < 3) return {1, seen + " and no more"};
  return {worst, seen};
}

/// Speed after the impact of a ball dropped from `height` (m), as a fraction of the speed of its impact.
struct Rebound {
  double by_height = 0;  ///< from the greatest height after the impact
  double by_speed = 0;   ///< from the greatest speed upwards
};
Rebound rebound(const std::string& motion, double e, double mass = 1, double height = 1, double rate = 1000) {
  constexpr double radius = 0.05;
  Trial t(motion, rate);
  t.add_ground();
  const RobotView& r = t.add("ball", ball(mass, radius, 0.5, e), {{0, 0, height + radius}, Quat::Identity()});
  t.start();
  const double fall = std::sqrt(2 * height / g), step = 1 / rate;
  const auto steps = int((fall * (1 + 0.9 * e) + 0.05) / step) + 5;  // by then it is up, or at rest
  bool has_met = false;
  double highest = 0, fastest = 0;
  for (int i = 0; i < steps; ++i) {
    const double before = t.twist(r).linear.z();
    t.run_for(step);
    const double v = t.twist(r).linear.z();
    has_met = has_met || v > 0.5 * before;  // its speed grows until it meets the ground
    if (!has_met) continue;
    fastest = std::max(fastest, v);
    if (fastest > 0) highest = std::max(highest, t.pose(r).position.z() - radius);
  }
  return {has_met ? std::sqrt(highest / height) : 1e3, has_met ? fastest / std::sqrt(2 * g * height) : 1e3};
}
double rebound_of(const std::string& motion, double e, double mass = 1) { return rebound(motion, e, mass).by_height; }
/// Returns the largest error at several rates, for impacts early and late in a step.
Outcome rebounds_alike(const std::string& motion, std::initializer_list<double> restitutions) {
  double worst = -1;
  std::string seen;
  for (const double e : restitutions)
    for (const double rate : {250.0, 1000.0, 4000.0})
      for (const double height : {0.3019, 0.3057, 1.0, 1.0074, 1.0148, 3.0, 3.013}) {
        const Rebound r = rebound(motion, e, 1, height, rate);
        const double value = e > 0 ? r.by_height : std::max(r.by_height, r.by_speed);
        if (std::abs(value - e) <= worst) continue;
        worst = std::abs(value - e);
        seen = text(value) + " for " + text(e) + " at " + text(rate) + " Hz from " + text(height) + " m";
      }
  return {worst, seen};
}
Outcome elastic_in_any_phase(const std::string& motion) { return rebounds_alike(motion, {0.3, 0.7, 0.9, 1}); }
Outcome plastic(const std::string& motion) { return rebounds_alike(motion, {0}); }
Outcome elastic(const std::string& motion) {
  const double seen = rebound_of(motion, 0.9);
  return {std::abs(seen - 0.9), text(seen) + " for 0.9"};
}
/// Checks 216 balls without friction in a box: most have an impact every few steps, many have several at once.
Outcome gas(const std::string& motion) {
  constexpr double half = 1.5, wall = 0.2, radius_of_ball = 0.2;
  Trial t(motion);
  t.set_gravity(Vec3::Zero());
  const auto surfaced = [](Shape shape) {
    shape.surface = {.friction = 0, .restitution = 1};
    return shape;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 size = Vec3::Constant(2 * half + 2 * wall), at = Vec3::Zero();
      size[axis] = wall;
      at[axis] = side * (half + 0.5 * wall);
      const Shape shape = surfaced(Shape::box(size));
      t.world().add_scenery("wall_" + std::to_string(axis) + (side > 0 ? "+" : "-"), {at, Quat::Identity()},
                            std::span<const Shape>(&shape, 1));
    }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> speed(-1.5, 1.5);
  std::vector<const RobotView*> balls;
  for (int i = 0; i < 216; ++i) {
    const Vec3 at = 0.5 * Vec3(i % 6, i / 6 % 6, i / 36) - Vec3::Constant(1.25);
    const double x = speed(random), y = speed(random), z = speed(random);
    balls.push_back(&t.add("ball_" + std::to_string(i), ball(1, radius_of_ball, 0, 1), {at, Quat::Identity()},
                           {{x, y, z}, Vec3::Zero()}));
  }
  t.start();
  const auto energy = [&] {
    double sum = 0;
    for (const RobotView* b : balls) sum += 0.5 * t.twist(*b).linear.squaredNorm();
    return sum;
  };
  const double before = energy();
  t.run_for(2);
  return relative(energy(), before);
}

/// Returns the largest error for masses from a gram to a thousand tons.
Outcome elastic_of_any_mass(const std::string& motion) {
  double worst = 0;
  std::string all;
  for (const double mass : {1e-3, 1e3, 1e6}) {
    const double seen = rebound_of(motion, 0.9, mass);
    worst = std::max(worst, std::abs(seen - 0.9));
    all += (all.empty() ? "" : " ") + text(seen);
  }
  return {worst, all + " for 0.9"};
}
Outcome gains_nothing(const std::string& motion) {
  const double seen = rebound_of(motion, 1);
  return {std::max(seen - 1, 0.0), text(seen) + " for 1"};
}

/// Returns how far the uppermost of five stacked boxes moves in 10 s.
Outcome stands(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  const RobotView* top = nullptr;
  for (int i = 0; i < 5; ++i)
    top = &t.add("box_" + std::to_string(i), block(1, {0.2, 0.2, 0.2}, 0.8), {{0, 0, 0.1 + 0.2 * i}, Quat::Identity()});
  t.start();
  t.run_for(1);
  const Vec3 before = t.pose(*top).position;
  t.run_for(10);
  const double moved = (t.pose(*top).position - before).norm();
  return {moved, text(moved) + " m, at " + text(t.pose(*top).position.z()) + " m"};
}

Outcome carries(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  const RobotView& r = t.add("box", block(3, {0.2, 0.2, 0.2}, 0.8), {{0, 0, 0.1}, Quat::Identity()});
  t.start();
  t.run_for(2);
  const double sunk = std::abs(t.pose(r).position.z() - 0.1);
  return {sunk, text(sunk) + " m"};
}

/// Returns the greatest depth for masses from a gram to ten thousand tons.
Outcome carries_any_mass(const std::string& motion) {
  double worst = 0;
  std::string all;
  for (const double mass : {1e-3, 1e3, 1e6, 1e7}) {
    Trial t(motion);
    t.add_ground();
    const RobotView& r = t.add("box", block(mass, {0.2, 0.2, 0.2}, 0.8), {{0, 0, 0.1}, Quat::Identity()});
    t.start();
    t.run_for(1);
    const double sunk = std::abs(t.pose(r).position.z() - 0.1);
    worst = std::max(worst, sunk);
    all += (all.empty() ? "" : " ") + text(sunk);
  }
  return {worst, all + " m"};
}

/// Checks the wrench of the ground on a box whose frame is not at its centre of mass.
Outcome weighs(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  Inertia inertia = solid_box(3, {0.2, 0.2, 0.2});
  inertia.com.x() = 0.03;
  const RobotView& r =
      t.add("box", test::single_body(with(Shape::box({0.2, 0.2, 0.2}), 0.8), inertia), {{0, 0, 0.1}, Quat::Identity()});
  t.start();
  t.run_for(2);
  const Wrench w = t.world().value(r.base(), keys::contact_wrench);
  const double weight = 3 * g;
  const double error = std::max((w.force - Vec3(0, 0, weight)).norm() / weight,
                                (w.torque - Vec3(0, -0.03 * weight, 0)).norm() / (0.1 * weight));
  return {error, text(w.force.z()) + " N for " + text(weight) + ", " + text(w.torque.y()) + " N m for " +
                     text(-0.03 * weight)};
}

/// Checks a ball that falls with 1 m/s to the side. By Coulomb's law its contact slides throughout, or stops (Routh).
Outcome routh_ball(const std::string& motion) {
  const double r = 0.05, e = 0.7, u = 1, v = std::sqrt(2 * g);
  Outcome worst;
  for (const double friction : {0.02, 0.2}) {
    Trial t(motion);
    t.add_ground(friction);
    const RobotView& b =
        t.add("ball", ball(1, r, friction, e), {{0, 0, 1 + r}, Quat::Identity()}, {{u, 0, 0}, Vec3::Zero()});
    t.start();
    t.run_for(0.5);
    const double impulse = std::min(friction * (1 + e) * v, 2.0 / 7 * u), spin = 2.5 * impulse / r;
    const double speed = t.twist(b).linear.x(), turns = t.twist(b).angular.y();
    const double error = std::max(std::abs(speed - (u - impulse)) / u, std::abs(turns - spin) / spin);
    worst.error = std::max(worst.error, error);
    worst.seen += text(speed) + " m/s for " + text(u - impulse) + ", " + text(turns) + " rad/s for " + text(spin) + " ";
  }
  return worst;
}

/// Checks a rod that strikes with one end: without friction, on its cone, and where friction stops the end.
Outcome routh_rod(const std::string& motion) {
  const double length = 1, e = 0.5, angle = 0.6, inertia = 1.0 / 12;
  const double x = 0.5 * length * std::cos(angle), z = -0.5 * length * std::sin(angle);
  Outcome worst;
  for (const double friction : {0.0, 0.3, 1.0}) {
    Trial t(motion);
    t.add_ground(friction);
    Shape s = with(Shape::capsule(1e-3, length), friction, e);
    s.origin.orientation = from_rpy(0, M_PI / 2, 0);
    const RobotView& rod = t.add("rod", test::single_body(s, {.mass = 1, .ixx = 1e-3, .iyy = inertia, .izz = inertia}),
                                 {{0, 0, 1 + 1e-3 - z}, from_rpy(0, angle, 0)});
    t.start();
    double before = 0;
    do {
      before = t.twist(rod).linear.z();
      t.run_for(0.001);
    } while (t.twist(rod).linear.z() < before && t.now() < 1'000'000'000);
    // change of the end's velocity by an impulse (p, 1) there
    const double kxx = 1 + z * z / inertia, kxz = -x * z / inertia, kzz = 1 + x * x / inertia;
    const double p = -std::min(friction, kxz / kxx), impulse = (1 + e) * std::sqrt(2 * g) / (kzz + kxz * p);
    const double spin = impulse * (z * p - x) / inertia, turns = t.twist(rod).angular.y();
    worst.error = std::max(worst.error, std::abs(turns / spin - 1));
    worst.seen += text(turns) + " rad/s for " + text(spin) + " ";
  }
  return worst;
}

}  // namespace

std::vector<Case> impact_cases() {
  return {
      {"a ball of restitution 0.7 bounces when it should", "s", feature_contact | feature_restitution, 0.01, bounces},
      {"a ball of restitution 0.9 comes up with 0.9 of its speed", "1", feature_contact | feature_restitution, 0.02,
       elastic},
      {"216 elastic balls in a box keep their energy for 2 s", "relative", feature_contact | feature_restitution, 0.01,
       gas},
      {"balls of 1 g to 1000 t and restitution 0.9 come up with 0.9 of their speed", "1",
       feature_contact | feature_restitution, 0.02, elastic_of_any_mass},
      {"a ball of restitution 1 gains nothing", "1", feature_contact | feature_restitution, 1e-3, gains_nothing},
      {"a ball of restitution 0 stays down", "1", feature_contact, 0.01, plastic},
      {"a ball rebounds by its restitution wherever in a step it lands", "1", feature_contact | feature_restitution,
       0.005, elastic_in_any_phase},
      {"a ball with speed to the side rebounds by Coulomb's impulse", "relative",
       feature_contact | feature_restitution | feature_friction, 0.02, routh_ball},
      {"a rod strikes with one end by Coulomb's impulse", "relative",
       feature_contact | feature_restitution | feature_friction, 0.02, routh_rod},
      {"a box lies on the ground, not in it", "m", feature_contact, 1e-3, carries},
      {"boxes of 1 g to 10000 t lie on the ground, not in it", "m", feature_contact, 1e-3, carries_any_mass},
      {"the ground carries a box with its weight, below its centre of mass", "relative",
       feature_contact | feature_link_dynamics, 0.02, weighs},
      {"five boxes stand one on the other for 10 s", "m", feature_contact | feature_friction, 1e-3, stands},
  };
}

}  // namespace muro::conformance
