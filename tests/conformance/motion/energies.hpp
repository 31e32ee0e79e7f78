// SPDX-License-Identifier: MIT
// Energy of a body without a drive, and of the springs of its contacts.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

/// Returns the energy of a body, J; potential energy is 0 at z = 0.
inline double energy_of(const Inertia& inertia, const Pose& pose, const Twist& twist) {
  const Mat3 axes = pose.orientation.toRotationMatrix();
  const Vec3 centre = pose * inertia.com, velocity = twist.at(centre - pose.position);
  const Vec3 spin = axes * inertia.tensor() * axes.transpose() * twist.angular;
  return 0.5 * inertia.mass * velocity.squaredNorm() + 0.5 * twist.angular.dot(spin) + inertia.mass * g * centre.z();
}

/// Returns the energy in the springs of contacts in motion.articulated, J. Each spring has 50 Hz for the mass of the
/// whole body, and a force of at most twice its weight.
inline double held_by_each(const Inertia& inertia, std::span<const Contact> contacts) {
  const double omega = 2 * M_PI * 50, stiffness = inertia.mass * omega * omega, cap = 2 * g / (omega * omega);
  double held = 0;
  for (const Contact& c : contacts)
    held += stiffness * (c.depth < cap ? 0.5 * c.depth * c.depth : cap * (c.depth - 0.5 * cap));
  return held;
}

/// Returns the energy in the springs of contact.penalty, J, for contacts with one normal. Together they have 50 Hz: for
/// the whole body if steps are so long that they are solved together, else for the effective mass at their middle.
inline double held_by_all(const Inertia& inertia, const Pose& pose, std::span<const Contact> contacts, double rate) {
  if (contacts.empty()) return 0;
  const double full = 2 * M_PI * 50, omega = std::min(0.6 * rate, full);
  Vec3 middle = Vec3::Zero();
  double squares = 0;
  for (const Contact& c : contacts) {
    middle += c.point / double(contacts.size());
    squares += c.depth * c.depth / double(contacts.size());
  }
  if (0.6 * rate < 0.75 * full) return 0.5 * full * full * inertia.mass * squares;
  const Mat3 axes = pose.orientation.toRotationMatrix();
  const Vec3 lever = (middle - pose * inertia.com).cross(contacts[0].normal);
  const double inverse_mass =
      1 / inertia.mass + lever.dot(axes * inertia.tensor().inverse() * axes.transpose() * lever);
  return 0.5 * omega * omega / inverse_mass * squares;
}

/// Returns the energy in the contacts of a body in this motion, J; 0 for engines, where it is unknown.
inline double held_by_springs(const std::string& motion, const Inertia& inertia, const Pose& pose,
                              std::span<const Contact> contacts, double rate) {
  if (motion == "motion.articulated") return held_by_each(inertia, contacts);
  return motion == "motion.simplified" ? held_by_all(inertia, pose, contacts, rate) : 0;
}

/// Means over 50 ms.
struct Energies {
  double of_body = 0;          ///< J
  double held_by_springs = 0;  ///< J
};

/// Returns the mean over 50 ms of what `sample()` returns after each step.
template <class Sample>
Energies mean_of_window(Trial& t, double rate, const Sample& sample) {
  const int steps = int(0.05 * rate);
  Energies mean;
  for (int i = 0; i < steps; ++i) {
    t.run_for(1 / rate);
    const Energies now = sample();
    mean.of_body += now.of_body / steps, mean.held_by_springs += now.held_by_springs / steps;
  }
  return mean;
}

/// Returns the largest gain of energy as a fraction of that at the start: the energy of the body at any later time,
/// less that of body and springs before. Springs count up to `most_held` (J). `first`: first of `means` that counts.
inline double gain_of(std::span<const Energies> means, double most_held = std::numeric_limits<double>::infinity(),
                      std::size_t first = 0) {
  double gain = 0;
  for (std::size_t i = first; i < means.size(); ++i)
    for (std::size_t k = i + 1; k < means.size(); ++k)
      gain = std::max(gain, means[k].of_body - means[i].of_body - std::min(means[i].held_by_springs, most_held));
  return gain / means.front().of_body;
}

}  // namespace muro::conformance
