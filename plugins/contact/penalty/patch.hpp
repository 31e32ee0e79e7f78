// SPDX-License-Identifier: MIT
// Effective masses of two bodies where they touch, over a double or SIMD lanes of robots.
#pragma once

#include "plugins/common/contact_geometry/pressure_cells.hpp"
#include "symmetric.hpp"

namespace muro::penalty {

using contact_geometry::same_direction;

/// Mass properties of a robot, in the frame of its base.
struct MassProperties {
  double inverse_mass = 0;         ///< 1/kg
  double com[3] = {};              ///< m
  double inverse_inertia[6] = {};  ///< 1/(kg m^2), about the centre of mass: xx, yy, zz, xy, xz, yz

  friend bool operator==(const MassProperties&, const MassProperties&) = default;
};
inline constexpr int mass_numbers = 10;
static_assert(sizeof(MassProperties) == mass_numbers * sizeof(double));

namespace law {
inline namespace MURO_ISA {

using lane::max, lane::select;

/// The inverse of the inertia of a free body. World axes.
template <class S>
struct Mobility {
  S mass;                ///< inverse, 1/kg
  Symmetric<S> inertia;  ///< inverse, 1/(kg m^2), about `centre`
  V3<S> centre;          ///< centre of mass, m
};

/// Returns the mobility in world axes. `mass`: the numbers of MassProperties, in their order.
template <class S>
MURO_INLINE Mobility<S> mobility_of(const S (&mass)[mass_numbers], const lane::PoseOf<S>& base) {
  const M3<S> axes = base.orientation.matrix();
  const Symmetric<S> inertia{mass[4], mass[5], mass[6], mass[7], mass[8], mass[9]};
  return {mass[0], rotated(axes, inertia), base.position + axes * V3<S>{mass[1], mass[2], mass[3]}};
}
MURO_INLINE Mobility<double> mobility_of(const MassProperties& mass, const lane::PoseOf<double>& base) {
  double numbers[mass_numbers];
  __builtin_memcpy(numbers, &mass, sizeof numbers);
  return mobility_of(numbers, base);
}

/// Inverse effective masses of a point, 1/kg: along the normal, and the sum over both tangential directions.
template <class S>
struct InverseEffectiveMass {
  S along, across;
  MURO_INLINE friend InverseEffectiveMass operator+(const InverseEffectiveMass& a, const InverseEffectiveMass& b) {
    return {a.along + b.along, a.across + b.across};
  }
};

/// Stiffness of a body on springs against translation, and against rotation about its centre of mass. World axes.
template <class S>
struct SpringStiffness {
  Symmetric<S> translation = scaled_identity(S(0)), rotation = scaled_identity(S(0));

  MURO_INLINE void operator+=(const SpringStiffness& b) { translation += b.translation, rotation += b.rotation; }
  /// Returns the same in the lanes of the mask, and 0 in the others.
  template <class M>
  MURO_INLINE SpringStiffness where(M mask) const {
    return {translation.where(mask), rotation.where(mask)};
  }
  /// Returns a bound of the largest eigenvalue of M^-1 K. For a matrix of two diagonal blocks, it is at most the sum of
  /// theirs. For a block, which is similar to a symmetric one, it is at most the root of the trace of its square.
  MURO_INLINE S max_eigenvalue_bound(const Mobility<S>& body) const {
    const V3<S> x = body.inertia * rotation.column_x(), y = body.inertia * rotation.column_y(),
                z = body.inertia * rotation.column_z();
    const S trace = (x.x * x.x + y.y * y.y + z.z * z.z) + S(2) * (x.y * y.x + x.z * z.x + y.z * z.y);
    return body.mass * translation.norm() + sqrt(max(trace, S(0)));
  }
};

/// A contact patch: the contact points of one pair of bodies with one normal. They act together.
///
/// The points of a patch have together the effective mass at their middle, 1 / (1/m + (r x n) . I^-1 (r x n)), each an
/// equal part. So a box that lands flat on four corners rebounds as a ball does.
template <class S>
struct Patch {
  V3<S> normal;
  V3<S> origin;                                  ///< m
  S count{0};                                    ///< number of points
  V3<S> sum{S(0), S(0), S(0)};                   ///< sum of the points, from the origin
  Symmetric<S> squares = scaled_identity(S(0));  ///< sums of the products of their coordinates

  MURO_INLINE Patch(const V3<S>& normal_of_all, const V3<S>& from) : normal(normal_of_all), origin(from) {}

  MURO_INLINE void add(const V3<S>& point) {
    const V3<S> d = point - origin;
    count += S(1);
    sum += d;
    squares += square(d);
  }
  /// Adds the point in the lanes of the mask.
  template <class M>
  MURO_INLINE void add_where(M mask, const V3<S>& point) {
    const S zero(0);
    const V3<S> d = select(mask, point - origin, {zero, zero, zero});
    count += select(mask, S(1), zero);
    sum += d;
    squares += square(d);
  }
  /// Returns the same patch with the origin `centre`.
  MURO_INLINE Patch seen_from(const V3<S>& centre) const {
    const V3<S> shift = origin - centre;
    Patch p(normal, centre);
    p.count = count;
    p.sum = sum + count * shift;
    p.squares = squares + mixed(sum, shift) + count * square(shift);
    return p;
  }
  /// Returns the value at the middle of the points. The origin is the centre of `body`.
  MURO_INLINE InverseEffectiveMass<S> at_middle(const Mobility<S>& body) const {
    const V3<S> r = sum * (S(1) / count), lever = cross(r, normal);
    const S along = dot(lever, body.inertia * lever);
    const S all = body.inertia.trace() * dot(r, r) - dot(r, body.inertia * r);
    return {body.mass + along, S(2) * body.mass + all - along};
  }
  /// Returns the stiffness of a body on springs in the points. The origin is the centre of the body. Each spring has
  /// the stiffness `along` the normal and `across` it.
  MURO_INLINE SpringStiffness<S> stiffness(S along, S across) const {
    const S more = along - across;
    return {scaled_identity(count * across) + (count * more) * square(normal),
            across * (scaled_identity(squares.trace()) + S(-1) * squares) + more * crossed(normal, squares)};
  }
};

/// Effective mass of each point of a patch, kg.
template <class S>
struct EffectiveMass {
  S along, across, inverse_across;

  EffectiveMass() = default;
  MURO_INLINE EffectiveMass(const InverseEffectiveMass<S>& middle, S points) {
    const S inverse_along = middle.along * points;
    inverse_across = middle.across * (S(0.5) * points);
    const S both = S(1) / (inverse_along * inverse_across);
    along = inverse_across * both;
    across = inverse_along * both;
  }
};

}  // namespace MURO_ISA
}  // namespace law
}  // namespace muro::penalty
