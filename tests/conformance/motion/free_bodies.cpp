// SPDX-License-Identifier: MIT
// Bodies that touch nothing. The boxes are from Peters and Hsu, Comparison of rigid body dynamic simulators for robotic
// simulation in Gazebo (ROSCon 2014): 10 kg, 0.1 x 0.4 x 0.9 m.
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

struct Box {
  Vec3 gravity, velocity, spin;
};
const Box simple{{0, 0, 0}, {-0.9, 0.4, 0.1}, {0.5, 0, 0}};
const Box complex{{0, 0, -9.8}, {-2, 2, 8}, {0.1, 5.0, 0.1}};
const Vec3 body_size(0.1, 0.4, 0.9);

/// Largest errors over 10 s.
struct Flight {
  double momentum = 0, energy = 0, position = 0;  ///< |dL| / |L|, |dE| / E, m
};

Flight fly(const std::string& motion, const Box& box) {
  Trial t(motion);
  t.set_gravity(box.gravity);
  const RobotView& r =
      t.add("box", block(10, body_size, 0.5), {{0, 0, 100}, Quat::Identity()}, {box.velocity, box.spin});
  t.start();
  const Mat3 inertia = solid_box(10, body_size).tensor();
  const auto momentum = [&] {
    const Quat& q = t.pose(r).orientation;
    return Vec3(q * Vec3(inertia * (q.conjugate() * t.twist(r).angular)));
  };
  const auto energy = [&] {
    const Vec3 w = t.pose(r).orientation.conjugate() * t.twist(r).angular;
    return 5 * t.twist(r).linear.squaredNorm() + 0.5 * w.dot(inertia * w) -
           10 * box.gravity.dot(t.pose(r).position - Vec3(0, 0, 100));
  };
  const Vec3 l = momentum();
  const double e = energy();
  Flight worst;
  for (int k = 1; k <= 100; ++k) {
    t.run_for(0.1);
    const double time = 0.1 * k;
    const Vec3 expected = Vec3(0, 0, 100) + box.velocity * time + 0.5 * box.gravity * time * time;
    worst.momentum = std::max(worst.momentum, (momentum() - l).norm() / l.norm());
    worst.energy = std::max(worst.energy, std::abs(energy() - e) / e);
    worst.position = std::max(worst.position, (t.pose(r).position - expected).norm());
  }
  return worst;
}

Outcome simple_momentum(const std::string& motion) {
  const double e = fly(motion, simple).momentum;
  return {e, text(e)};
}
Outcome complex_momentum(const std::string& motion) {
  const double e = fly(motion, complex).momentum;
  return {e, text(e)};
}
Outcome complex_energy(const std::string& motion) {
  const double e = fly(motion, complex).energy;
  return {e, text(e)};
}
Outcome complex_position(const std::string& motion) {
  const double e = fly(motion, complex).position;
  return {e, text(e)};
}

/// Compares the spin at 1 s with the elliptic functions of Euler's equations.
Outcome complex_rates(const std::string& motion) {
  Trial t(motion);
  t.set_gravity(complex.gravity);
  const RobotView& r =
      t.add("box", block(10, body_size, 0.5), {{0, 0, 100}, Quat::Identity()}, {complex.velocity, complex.spin});
  t.start();
  t.run_for(1);
  const Vec3 rates = t.pose(r).orientation.conjugate() * t.twist(r).angular;
  const double e = (rates - Vec3(3.423798442, 2.819185438, 3.928384449)).norm();
  return {e, text(rates.x()) + " " + text(rates.y()) + " " + text(rates.z())};
}

Outcome pushed(const std::string& motion) {
  Trial t(motion);
  t.set_gravity(Vec3::Zero());
  const RobotView& r = t.add("box", block(2, {0.2, 0.2, 0.2}, 0.5), {{0, 0, 1}, Quat::Identity()});
  Wrench& w = t.push(r);
  t.start();
  w = {{3, 0, 0}, {0, 0, 0.1}};
  t.run_for(1);
  const double spin = 0.1 / solid_box(2, {0.2, 0.2, 0.2}).izz;
  return {std::max(std::abs(t.twist(r).linear.x() - 1.5), std::abs(t.twist(r).angular.z() - spin)),
          text(t.twist(r).linear.x()) + " m/s for 1.5, " + text(t.twist(r).angular.z()) + " rad/s for " + text(spin)};
}

}  // namespace

std::vector<Case> free_body_cases() {
  constexpr Features flies = feature_forces | feature_gyroscopic;
  return {
      {"a force and a torque speed a body up as Newton and Euler say", "m/s, rad/s", feature_forces, 1e-9, pushed},
      {"a box that turns about a principal axis keeps its angular momentum", "relative", flies, 1e-9, simple_momentum},
      {"a tumbling box keeps its angular momentum", "relative", flies, 1e-6, complex_momentum},
      {"a tumbling box keeps its energy", "relative", flies, 1e-6, complex_energy},
      {"a tumbling box flies a parabola", "m", flies, 1e-6, complex_position},
      {"a tumbling box turns as Euler's equations say", "rad/s", flies, 1e-3, complex_rates},
  };
}

}  // namespace muro::conformance
