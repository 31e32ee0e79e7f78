// SPDX-License-Identifier: MIT
// The force of one contact, over a double or SIMD lanes of robots: a spring and damper along the normal, a spring with
// a slider across it.
//
// Forces are given per unit of effective mass (m/s^2). Both directions are integrated linearly implicitly: the force of
// a step is that of spring and damper in the middle of the step, predicted for a body on which only this contact acts.
// This is the implicit midpoint rule, exact in energy for a spring. If several contacts act on one body, `load` is the
// ratio by which its stiffest motion is stiffer than one contact assumes. The force is then softened as much as
// stability requires.
#pragma once

#include "muro/simd/geometry.hpp"
#include "plugins/common/contact_geometry/pressure_cells.hpp"

namespace muro::penalty {

/// Stiffness of all contacts of a step.
struct Stiffness {
  double omega = 0;  ///< rad/s: frequency of a body with the effective mass on the contact; omega h <= max_phase_step
  double h = 0;      ///< s: length of the step
};
/// Limit of omega h up to which a rebound gains no energy, at any time of the impact in the step.
inline constexpr double max_phase_step = 0.6;

/// Reach of a contact that lasts. It moves with the bodies: its point is at most this (m), plus so many times the slip
/// in a step, away from its friction anchor of the step before.
inline constexpr double lasting_reach = 1e-3, lasting_slips = 2;

namespace law {
inline namespace MURO_ISA {

using contact_geometry::least_spin;
using lane::any, lane::max, lane::min, lane::select, lane::sqrt, lane::V3;

/// Returns tanh x for 0 <= x <= 2 max_phase_step, to some units in the last place: ten terms of Lambert's continued
/// fraction x / (1 + x^2 / (3 + x^2 / (5 + ...))).
template <class S>
MURO_INLINE S tanh(S x) {
  const S y = x * x;
  const S above = S(654729075) + y * (S(91891800) + y * (S(2837835) + y * (S(25740) + y * S(55))));
  const S below = S(654729075) + y * (S(310134825) + y * (S(18918900) + y * (S(315315) + y * (S(1485) + y))));
  return x * above / below;
}

/// The spring and damper along the normal. Values that are equal for all contacts are computed once.
template <class S>
struct NormalLaw {
  Stiffness stiffness;
  S zeta;            ///< damping ratio, at most max_damping_ratio
  S load;            ///< load of the bodies, >= 0
  S spring, damper;  ///< 1/s^2, 1/s
  S soft;            ///< 1/s^2: stiffness of the softened spring
  S lag;             ///< s: at the depth of the bodies this much later, the spring alone has the force of both

  MURO_INLINE NormalLaw(const Stiffness& s, S damping_ratio, S load_of_bodies)
      : stiffness(s), zeta(damping_ratio), load(load_of_bodies) {
    // With tanh, the midpoint rule damps a speed by exp(-2 zeta omega h), as it should.
    const double w = s.omega, h = s.h;
    const S one(1), z = law::tanh(zeta * S(w) * S(h)), beta = z + S(0.25 * w * w * h * h);
    const S softening = one / max(load * beta, one + beta);
    spring = S(w * w) * softening;
    damper = (S(0.5 * w * w * h) + S(2 / h) * z) * softening;
    lag = S(2 / w) * zeta;
    soft = S(w * w) * (one + beta) * softening;
  }

  /// Returns the force, >= 0. `depth`: m; `approach`: speed at which the depth grows, m/s.
  MURO_INLINE S force(S depth, S approach) const {
    const S zero(0), h(stiffness.h);
    const S spring_depth = depth + lag * approach;
    S result = max(spring * depth + damper * approach, zero);
    const S way = approach * h;
    const auto separates = (approach < zero) & (spring_depth < -way);
    const auto impacts = way > depth;
    if (!any(separates | impacts)) return result;
    if (any(separates)) result = select(separates, force_at_separation(*this, spring_depth, approach), result);
    if (any(impacts)) result = select(impacts, force_at_impact(*this, depth, approach), result);
    return result;
  }

 private:
  /// Returns the force if the bodies separate within this step: the energy stored in the spring becomes speed, not
  /// more.
  [[gnu::noinline, gnu::cold]] static S force_at_separation(NormalLaw own, S spring_depth, S approach) {
    const double w2 = own.stiffness.omega * own.stiffness.omega;
    const S stored = S(w2) * spring_depth * spring_depth;
    const S force = stored / (sqrt(approach * approach + stored) - approach) / S(own.stiffness.h) * (own.soft / S(w2));
    return select(spring_depth <= S(0), S(0), force);
  }

  /// Returns the force if the contact began within the last step, a time depth / approach ago, and the bodies came this
  /// deep without a force. The bodies get the energy that they would have if the contact had acted since then. But they
  /// do not rebound too early.
  [[gnu::noinline, gnu::cold]] static S force_at_impact(NormalLaw own, S depth, S approach) {
    const double w = own.stiffness.omega, w2 = w * w;
    const S h(own.stiffness.h), zero(0), one(1), half(0.5);
    const S since = h + depth / approach, z = law::tanh(own.zeta * S(w) * since);
    const S beta = z + S(0.25 * w2) * since * since;
    const S change = -(S(0.5 * w2) * since + S(2) * z / since) * approach / max(own.load * beta, one + beta);
    const S speed = approach + since * change, path = since * approach, dip = path + half * since * since * change;
    const S energy = min(speed * speed + own.soft * dip * dip, approach * approach);
    // (approach + h a)^2 + soft (path + h^2 a / 2)^2 = energy, for the acceleration a of this step
    const S a = one + S(0.25) * own.soft * h * h, half_b = approach + half * own.soft * h * path;
    const S c = approach * approach + own.soft * path * path - energy;
    const S push = c / (half_b + sqrt(max(half_b * half_b - a * c, zero)));
    return max(min(push, approach - min(speed, zero)) / h, zero);
  }
};

/// Returns the speed (m/s) of the ends of a cell about its middle, without the part that does not count (least_spin).
/// `spin`: the whole velocity, m/s. See FrictionLaw.
template <class S>
MURO_INLINE S speed_of_ends(const V3<S>& spin) {
  const S square = dot(spin, spin);
  if (!any(square > S(least_spin * least_spin))) return S(0);
  return max(sqrt(square) - S(least_spin), S(0));
}

/// The spring across the normal, critically damped. The slip adds to its tangential displacement until the force
/// reaches its limit. Then the body slides, and the displacement stays that of the limit at rest (Cundall and Strack, A
/// discrete numerical model for granular assemblies, Geotechnique 29, 1979). The limit is a circle, so friction is the
/// same in every direction.
///
/// A point of a patch represents a cell of the area that touches (see pressure_cells.hpp). If the patch spins, the ends
/// of the cell move against its middle. While the ends move faster than the middle, one part of the cell slides one way
/// and the rest the other way. Their sum is below the limit, in the ratio in which the middle is slower than the ends.
/// This is a damper in series with the spring.
template <class S>
struct FrictionLaw {
  S spring, damper;  ///< 1/s^2, 1/s
  S compliance;      ///< s^2: displacement by force
  S held;            ///< 1/s: change of the force within a step, per slip
  double h;          ///< s

  MURO_INLINE FrictionLaw(const Stiffness& s, S load) {
    const double w = s.omega, beta = w * s.h + 0.5 * w * w * s.h * s.h;
    const S softening = max(load * S(beta), S(1 + beta));
    const S part = S(1) / softening;
    spring = S(w * w) * part;
    damper = S(2 * w + 0.5 * w * w * s.h) * part;
    compliance = softening * S(-1 / (w * w));
    h = s.h;
    held = damper + S(h) * spring;
  }

  /// Returns the force on the body that moves with `slip` (m/s) over the other. `displacement` (m) includes the path of
  /// the last step; `most`: the limit, m/s^2; `spin`: m/s, see speed_of_ends().
  MURO_INLINE V3<S> force(V3<S>& displacement, const V3<S>& slip, S most) const {
    V3<S> f = -(spring * displacement) - damper * slip;
    const S size2 = dot(f, f);
    slide(f, displacement, size2 > most * most, most, size2);
    return f;
  }
  /// Returns the force of a patch that spins. Without spin, it has the same bits as above.
  MURO_INLINE V3<S> force(V3<S>& displacement, const V3<S>& slip, S most, S spin) const {
    V3<S> f = -(spring * displacement) - damper * slip;
    const S limit = most + held * spin, size2 = dot(f, f);
    const auto slides = size2 > limit * limit;
    const auto gives_way = (spin > S(0)) & !slides;
    if (any(gives_way)) {
      const S part = S(1) / max(limit, S(1e-300));
      displacement = select(gives_way, displacement + f * (S(h) * spin * part), displacement);
      f = select(gives_way, f * (most * part), f);
    }
    slide(f, displacement, slides, most, size2);
    return f;
  }

 private:
  /// Limits the force in the lanes that slide, and sets their displacement. `size2`: the square of the force before.
  template <class M>
  MURO_INLINE void slide(V3<S>& f, V3<S>& displacement, M slides, S most, S size2) const {
    if (!any(slides)) return;
    f = select(slides, f * (most * (S(1) / sqrt(size2))), f);
    displacement = select(slides, compliance * f, displacement);
  }
};

}  // namespace MURO_ISA
}  // namespace law
}  // namespace muro::penalty
