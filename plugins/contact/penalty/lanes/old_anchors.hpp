// SPDX-License-Identifier: MIT
// Friction anchors of the step before, over SIMD lanes of robots.
#pragma once

#include "muro/simd/rows.hpp"
#include "plugins/contact/penalty/scenery_kernel.hpp"

namespace muro::penalty::law {
inline namespace MURO_ISA {

using lane::count_of, lane::load_rows, lane::Places;

/// Friction anchors of a group from the step before: n of them, or as many as a robot may have.
template <class S, int n>
struct OldAnchors {
  V3<S> at[n], displacement[n], last_way[n];

  MURO_INLINE void load(int k, const Places<S>& places, int number) {
    S g[anchor_numbers];
    load_rows(places, number, g);
    at[k] = {g[0], g[1], g[2]};
    displacement[k] = {g[3], g[4], g[5]};
  }
  MURO_INLINE void load_way(int k, const Places<S>& places, int number) {
    S g[3];
    load_rows(places, number, g);
    last_way[k] = {g[0], g[1], g[2]};
  }
  /// Returns the tangential displacement of the nearest of the first `count`. `way`: out, m, from it to `point`.
  MURO_INLINE V3<S> nearest(const V3<S>& point, int count, V3<S>& way) const {
    V3<S> best = at[0];
    const V3<S> found = of_nearest(displacement, point, count, best);
    way = point - best;
    return found;
  }
  /// Returns the way of the nearest anchor in the step before.
  MURO_INLINE V3<S> way_of_nearest(const V3<S>& point, int count) const {
    V3<S> best = at[0];
    return of_nearest(last_way, point, count, best);
  }
  /// Returns the element of `values` of the nearest anchor. `best`: in, the first anchor; out, the nearest.
  MURO_INLINE V3<S> of_nearest(const V3<S> (&values)[n], const V3<S>& point, int count, V3<S>& best) const {
    V3<S> found = values[0];
    for (int k = 1; k < count; ++k) {
      // the point is on its side of the plane between both
      const auto nearer = dot(at[k] - best, (point + point) - (at[k] + best)) > S(0);
      found = select(nearer, values[k], found);
      best = select(nearer, at[k], best);
    }
    return found;
  }
  /// Returns the square of the distance to the nearest anchor, m^2.
  MURO_INLINE S least_distance2(const V3<S>& point, int count) const {
    S least = distance2(point, 0);
    for (int k = 1; k < count; ++k) least = min(distance2(point, k), least);
    return least;
  }
  MURO_INLINE S distance2(const V3<S>& point, int k) const {
    const V3<S> away = at[k] - point;
    return dot(away, away);
  }
};

}  // namespace MURO_ISA
}  // namespace muro::penalty::law
