// SPDX-License-Identifier: MIT
// Motion of contact points over a body within a step.
#pragma once

#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Way of a point beyond that of the origin of its body, in the frame of the body.
template <class S>
struct Travel {
  V3<S> half, all;  ///< m: in half of the step, and in the step
};

/// Returns the way of the lowest point of a rim about the origin of its body in a step (m), if the rim leans; else
/// `other`. `rim`: m, its axis, as long as its radius; `arm`: m, to the point; `w`: rad/s, of the body.
template <class S>
[[gnu::noinline]] V3<S> along_rim(const V3<S>& rim, const V3<S>& normal, const V3<S>& arm, const V3<S>& w, double dt,
                                  const V3<S>& other) {
  constexpr double least_lean = 1e-2;  // rad: angle of its face against the ground
  const S square = dot(rim, rim), radius = sqrt(max(square, S(1e-12)));
  const V3<S> axis = rim * (S(1) / radius), turning = cross(w, axis);
  const S rises = dot(normal, axis);
  const V3<S> up = normal - rises * axis;  // lies in the plane of the rim
  const S lean = sqrt(max(dot(up, up), S(least_lean * least_lean)));
  const V3<S> down = up * (S(-1) / lean), change = S(-1) * (dot(normal, turning) * axis + rises * turning);
  const V3<S> rate = cross(w, arm - radius * down) - (radius / lean) * (change - dot(down, change) * down);
  return select((square > S(0)) & (lean > S(least_lean)), S(dt) * rate, other);
}

/// Returns the travel of a point: a parabola through the last two steps, or the shorter of them if they differ much,
/// since points of edges and corners jump. If they are not known, it is the lowest point of a rim, or turns with the
/// body about the normal, as on a wheel that rolls along a curve. `way`, `last`: m, world, of the last step and the one
/// before; `normal`, `arm` (m, to the point): in the frame of the body; `rims()`: rims as in along_rim(), if some have
/// them.
template <class S, class Rims>
MURO_INLINE Travel<S> travel_of(const V3<S>& way, const V3<S>& last, MaskOf<S> is_known, const V3<S>& normal,
                                const V3<S>& arm, const BodyStep<S>& body, bool has_rims, const Rims& rims, double dt) {
  constexpr double least = 1e-12;  // m: smaller values are rounding
  const S square = dot(way, way), of_last = dot(last, last), rest(least * least);
  const V3<S> change = way - last, shorter = select(square < of_last, way, last);
  const MaskOf<S> goes_on = is_known & (min(square, of_last) > rest);
  V3<S> turned = S(dt) * (dot(body.w, normal) * cross(normal, arm));
  const MaskOf<S> is_fresh = (!is_known) | ((square > rest) & !goes_on);
  if (has_rims && lane::any(is_fresh))
    turned = select(is_fresh, along_rim(rims(), normal, arm, body.w, dt, turned), turned);
  if (!lane::any(goes_on)) return {S(0.5) * turned, turned};
  const MaskOf<S> bends = dot(change, change) < S(0.25) * min(square, of_last);
  const V3<S> half = select(bends, S(0.5) * way + S(0.375) * change, S(0.5) * shorter);
  const V3<S> all = select(bends, way + change, shorter);
  const V3<S> of_origin = S(dt) * body.v;
  return {select(goes_on, transposed_times(body.axes, half) - S(0.5) * of_origin, S(0.5) * turned),
          select(goes_on, transposed_times(body.axes, all) - of_origin, turned)};
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
