// SPDX-License-Identifier: MIT
// Inertias that joints move, of a pack of robots: those of plugins/motion/common/position_drive/moved_inertias.hpp.
#pragma once

#include "dynamics.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Several bodies as one, by their moments about a point; world axes.
template <class S>
struct Composite {
  S mass;         ///< kg
  V3<S> first;    ///< kg m
  Sym<S> second;  ///< kg m^2: tensor of inertia

  MURO_INLINE Composite& operator+=(const Composite& b) {
    mass += b.mass, first += b.first;
    second.xx += b.second.xx, second.yy += b.second.yy, second.zz += b.second.zz;
    second.yz += b.second.yz, second.zx += b.second.zx, second.xy += b.second.xy;
    return *this;
  }
};

/// Returns one body alone, about the point `about` (m, world).
template <class S>
MURO_INLINE Composite<S> composite_of(const Masses<S>& masses, int i, const BodyStep<S>& body, const V3<S>& about) {
  S n[Mass::numbers];
  masses.load(i, n);
  const V3<S> d = body.origin - about, h = body.axes * V3<S>{n[1], n[2], n[3]};
  const S m = n[0], dh = S(2) * dot(d, h) + m * dot(d, d);
  const V3<S> e = h + d * (S(0.5) * m);  // d h' + h d' + m d d' = d e' + e d'
  Sym<S> second = out_of(body.axes, Sym<S>{n[4], n[5], n[6], n[7], n[8], n[9]});
  second.xx += dh - S(2) * d.x * e.x, second.yy += dh - S(2) * d.y * e.y, second.zz += dh - S(2) * d.z * e.z;
  second.yz -= d.y * e.z + d.z * e.y, second.zx -= d.z * e.x + d.x * e.z, second.xy -= d.x * e.y + d.y * e.x;
  return {m, h + m * d, second};
}

/// Returns the inertia (kg m^2 or kg) about or along `axis` through `p`, from the point of the moments.
template <class S>
MURO_INLINE S along(const Composite<S>& c, bool slides, const V3<S>& axis, const V3<S>& p) {
  if (slides) return c.mass;
  const V3<S> arm = p - axis * dot(axis, p);
  return dot(axis, c.second * axis) - S(2) * dot(arm, c.first) + c.mass * dot(arm, arm);
}

template <class S>
MURO_INLINE V3<S> axis_of(const Body& b, const BodyStep<S>& body) {
  return b.axis == 0 ? body.axes.x : b.axis == 1 ? body.axes.y : body.axes.z;
}

/// Puts the larger of the inertias of both sides of each joint, without its armature, into BodyStep::D. Bodies are
/// placed. `waiting`: as many as slots.
template <class S>
[[gnu::noinline]] void find_moved_inertias(const Structure& s, const Masses<S>& masses, BodyStep<S>* bodies,
                                           Composite<S>* waiting) {
  const V3<S> about = bodies[0].origin;
  Composite<S> all;
  for (int i = s.count; i-- > 0;) {
    const Body& b = s.bodies[i];
    Composite<S> c = composite_of(masses, i, bodies[i], about);
    if (b.slot >= 0) c += waiting[b.slot];
    if (i == 0) {
      all = c;
      break;
    }
    bodies[i].D = lane::max(along(c, b.slides, axis_of(b, bodies[i]), bodies[i].origin - about), S(0));
    if (b.first)
      waiting[b.parent_slot] = c;
    else
      waiting[b.parent_slot] += c;
  }
  if (s.fixed) return;
  for (int i = 1; i < s.count; ++i) {
    const Body& b = s.bodies[i];
    const S both = along(all, b.slides, axis_of(b, bodies[i]), bodies[i].origin - about);
    bodies[i].D = lane::max(bodies[i].D, both - bodies[i].D);
  }
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
