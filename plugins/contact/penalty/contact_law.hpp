// SPDX-License-Identifier: MIT
// The force of one contact, free of properties: a spring and damper along the normal, a spring with a slider across.
//
// Forces are given per unit of effective mass (m/s^2). Both directions are integrated linearly implicitly: the force
// of a step is the one that spring and damper have in the middle of that step, predicted for a body that this contact
// alone acts on. That is the implicit midpoint rule, exact in energy for a spring. Where several contacts act on one body,
// `load` tells how much stiffer its stiffest motion is than one contact assumes, and the force is softened as far as
// stability asks for it.
#pragma once

#include <algorithm>
#include <cmath>

#include "muro/geometry.hpp"

namespace muro::penalty {

/// Coefficient of restitution of the linear spring-damper whose force never pulls, for the damping ratio `zeta`
/// (Schwager and Poeschel, Coefficient of restitution and linear-dashpot model revisited, Granular Matter 9, 2007,
/// their three cases in one: ln e = -2 zeta acos(zeta) / sqrt(1 - zeta^2)).
inline double restitution_of(double zeta) {
  const double rest = 1 - zeta * zeta;
  if (std::abs(rest) < 1e-8) return std::exp(-2.0);
  const double angle = rest > 0 ? std::acos(zeta) : std::acosh(zeta);
  return std::exp(-2 * zeta * angle / std::sqrt(std::abs(rest)));
}

/// Critical damping, e = 0.135. More would make a contact sluggish, and asks for shorter steps.
inline constexpr double greatest_damping_ratio = 1;

/// The damping ratio for a coefficient of restitution from 0 to 1; by bisection, so ask once a material.
inline double damping_ratio_of(double restitution) {
  double low = 0, high = greatest_damping_ratio;
  if (restitution <= restitution_of(high)) return high;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (restitution_of(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// What all contacts of a step have in common.
struct Stiffness {
  double omega = 0;  ///< rad/s: of a body with the effective mass on the contact; omega h <= finest_step
  double h = 0;      ///< s: length of the step
};
/// Up to here, a rebound gains no energy, wherever in the step the bodies meet.
inline constexpr double finest_step = 0.6;

/// Damping of one pair of materials.
struct Damping {
  double ratio = 0;  ///< zeta
  double midpoint = 0;  ///< tanh(zeta omega h): with it the midpoint rule damps a speed by exp(-2 zeta omega h), as it should
};

inline Damping damping_of(double restitution, const Stiffness& s) {
  const double ratio = damping_ratio_of(restitution);
  return {ratio, std::tanh(ratio * s.omega * s.h)};
}

/// Force along the normal, >= 0. `depth` in m; `approach`: speed at which it grows, m/s.
inline double normal_force(const Stiffness& s, const Damping& damping, double load, double depth, double approach) {
  const double w = s.omega, h = s.h;
  const double beta = damping.midpoint + 0.25 * w * w * h * h, d = std::max(1 + beta, load * beta);
  if (approach * h > depth) {
    // They met within the last step, a time depth / approach ago, and came this deep without a force. The bodies get
    // the energy that they would have, had the contact acted since then; but they do not rebound before their time.
    const double since = h + depth / approach, z = std::tanh(damping.ratio * w * since);
    const double late = z + 0.25 * w * w * since * since, ww = w * w * (1 + beta) / d;  // as soft as the contact is
    const double change = -(0.5 * w * w * since + 2 * z / since) * approach / std::max(1 + late, load * late);
    const double speed = approach + since * change, way = since * approach, dip = way + 0.5 * since * since * change;
    const double energy = std::min(speed * speed + ww * dip * dip, approach * approach);
    // (approach + h a)^2 + ww (way + h^2 a / 2)^2 = energy, for the acceleration a of this step
    const double a = 1 + 0.25 * ww * h * h, half_b = approach + 0.5 * ww * h * way;
    const double c = approach * approach + ww * way * way - energy;
    const double push = c / (half_b + std::sqrt(std::max(0.0, half_b * half_b - a * c)));
    return std::max(0.0, std::min(push, approach - std::min(0.0, speed)) / h);
  }
  const double level = depth + 2 * damping.ratio / w * approach;  // where the force stands, as a depth
  if (approach < 0 && level < -approach * h) {
    // They part within this step: what the spring still holds becomes speed, and no more.
    if (level <= 0) return 0;
    const double gain = w * w * level * level / (std::sqrt(approach * approach + w * w * level * level) - approach);
    return gain / h * (1 + beta) / d;
  }
  const double middle = w * w * (depth + 0.5 * h * approach) + 2 * damping.midpoint / h * approach;
  return std::max(0.0, middle / d);
}

/// Force across the normal on the body that moves with `slip` (m/s) over the other: a spring, critically damped, stretched by
/// what the body has slipped, until the force reaches `most` (m/s^2); from there on it slides and the spring keeps the
/// stretch (m) that holds `most` at rest (Cundall and Strack, A discrete numerical model for granular assemblies,
/// Geotechnique 29, 1979). The limit is a circle, so friction is the same in every direction.
/// `stretch` includes the way of the last step.
inline Vec3 friction_force(const Stiffness& s, double load, Vec3& stretch, const Vec3& slip, double most) {
  const double w = s.omega, h = s.h;
  const double beta = w * h + 0.5 * w * w * h * h, d = std::max(1 + beta, load * beta);
  const Vec3 force = -(w * w * stretch + (2 * w + 0.5 * w * w * h) * slip) / d;
  const double size2 = force.squaredNorm();
  if (size2 <= most * most) return force;
  const Vec3 limited = force * (most / std::sqrt(size2));
  stretch = limited * (-d / (w * w));
  return limited;
}

}  // namespace muro::penalty
