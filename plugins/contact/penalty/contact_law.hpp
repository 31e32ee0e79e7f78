// SPDX-License-Identifier: MIT
// The force of one contact, free of properties: a spring and damper along the normal, a spring with a slider across.
//
// Forces are given per unit of effective mass (m/s^2). Both directions are integrated linearly implicitly: the force
// of a step is the one that spring and damper have in the middle of that step, predicted for a body that this contact
// alone acts on. That is the implicit midpoint rule, exact in energy for a spring. Where several contacts act on one
// body, `load` tells how much stiffer its stiffest motion is than one contact assumes, and the force is softened as far
// as stability asks for it.
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

/// The spring and damper along the normal, with everything that does not change from contact to contact worked out.
struct NormalLaw {
  NormalLaw() = default;
  /// `zeta`: damping ratio.
  NormalLaw(const Stiffness& s, double zeta_, double load_) : w(s.omega), h(s.h), zeta(zeta_), load(load_) {
    // With tanh, the midpoint rule damps a speed by exp(-2 zeta omega h), as it should.
    const double z = std::tanh(zeta * w * h), beta = z + 0.25 * w * w * h * h, d = std::max(1 + beta, load * beta);
    spring = w * w / d;
    damper = (0.5 * w * w * h + 2 * z / h) / d;
    level = 2 * zeta / w;
    soft = w * w * (1 + beta) / d;
  }

  /// Force, >= 0. `depth` in m; `approach`: speed at which it grows, m/s.
  double force(double depth, double approach) const {
    if (approach * h > depth) return force_at_meeting(depth, approach);
    const double standing = depth + level * approach;  // where the force stands, as a depth
    if (approach < 0 && standing < -approach * h) {
      // They part within this step: what the spring still holds becomes speed, and no more.
      if (standing <= 0) return 0;
      const double held = w * w * standing * standing;
      return held / (std::sqrt(approach * approach + held) - approach) / h * (soft / (w * w));
    }
    return std::max(0.0, spring * depth + damper * approach);
  }

 private:
  /// They met within the last step, a time depth / approach ago, and came this deep without a force. The bodies get the
  /// energy that they would have, had the contact acted since then; but they do not rebound before their time.
  double force_at_meeting(double depth, double approach) const {
    const double since = h + depth / approach, z = std::tanh(zeta * w * since), beta = z + 0.25 * w * w * since * since;
    const double change = -(0.5 * w * w * since + 2 * z / since) * approach / std::max(1 + beta, load * beta);
    const double speed = approach + since * change, way = since * approach, dip = way + 0.5 * since * since * change;
    const double energy = std::min(speed * speed + soft * dip * dip, approach * approach);
    // (approach + h a)^2 + soft (way + h^2 a / 2)^2 = energy, for the acceleration a of this step
    const double a = 1 + 0.25 * soft * h * h, half_b = approach + 0.5 * soft * h * way;
    const double c = approach * approach + soft * way * way - energy;
    const double push = c / (half_b + std::sqrt(std::max(0.0, half_b * half_b - a * c)));
    return std::max(0.0, std::min(push, approach - std::min(0.0, speed)) / h);
  }

  double w = 1, h = 1, zeta = 0, load = 1;
  double spring = 0, damper = 0;  ///< 1/s^2, 1/s
  double level = 0;               ///< s
  double soft = 0;                ///< 1/s^2: of the spring, as softened
};

/// The spring across the normal, critically damped. It is stretched by what a body slips on the other, until the force
/// reaches its limit; from there on the body slides, and the spring keeps the stretch that holds the limit at rest
/// (Cundall and Strack, A discrete numerical model for granular assemblies, Geotechnique 29, 1979). The limit is a
/// circle, so friction is the same in every direction.
struct FrictionLaw {
  FrictionLaw() = default;
  FrictionLaw(const Stiffness& s, double load) {
    const double w = s.omega, beta = w * s.h + 0.5 * w * w * s.h * s.h, d = std::max(1 + beta, load * beta);
    spring = w * w / d;
    damper = (2 * w + 0.5 * w * w * s.h) / d;
    give = -1 / spring;
  }

  /// Force on the body that moves with `slip` (m/s) over the other. `stretch` (m) includes the way of the last step;
  /// `most`: the limit, m/s^2.
  Vec3 force(Vec3& stretch, const Vec3& slip, double most) const {
    const double x = -spring * stretch.x() - damper * slip.x(), y = -spring * stretch.y() - damper * slip.y(),
                 z = -spring * stretch.z() - damper * slip.z(), size2 = x * x + y * y + z * z;
    if (size2 <= most * most) return {x, y, z};
    const double part = most / std::sqrt(size2), held = part * give;
    stretch = {held * x, held * y, held * z};
    return {part * x, part * y, part * z};
  }

 private:
  double spring = 1, damper = 0;  ///< 1/s^2, 1/s
  double give = -1;               ///< s^2: stretch by force
};

}  // namespace muro::penalty
