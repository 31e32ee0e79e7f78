// SPDX-License-Identifier: MIT
#pragma once

#include "terrain_clearance.hpp"
#include "terrain_facets.hpp"
#include "terrain_frame.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// Clearance of a box, mesh or capsule above the surface of a heightmap. `Shape` is ShapeInWorld<S>, or has its
/// functions.
template <class S, class Shape>
class ShapeClearance {
 public:
  ShapeClearance(const Shape& at, const TerrainGrid& grid)
      : at_(at), grid_(grid), half_(at.half()), radius_(radius_of_all(at.kind(), half_)) {}

  /// Returns the distance (m) that all of its points may move, in any direction, until it may touch the surface;
  /// negative where it may touch now. The computation is cheap, so the result may be much less than the true distance.
  /// Outside of `lanes` the result is any number that is not negative.
  MURO_INLINE S find(MaskOf<S> lanes) const {
    const V3<S> centre = to_map(grid_, at_.centre() - lane::splat<S>(grid_.origin));
    const S beside = beyond_rim(grid_, centre, radius_);
    const TerrainLevel* const level = grid_.level_for(radius_);
    if (!level) return select(lanes, beside, S(0));
    const NearSlopes<S> near = slopes_near(grid_, *level, centre);
    const S over = -(near.rise + reach_along(near.slopes)) / sqrt(near.slopes.up2());
    const auto is_over = over >= S(0);
    const S far = select(lanes, select(is_over, min(over, S(level->reach - radius_)), beside), S(0));
    return any(!(far >= S(0))) ? with_closer_look(far, centre) : far;
  }

 private:
  MURO_INLINE V3<S> axis(int k) const { return to_map(grid_, at_.axis(k)); }

  /// Returns the reach (m) of the shape from its centre along the upward vector of slopes, times that vector's length.
  MURO_INLINE S reach_along(const Slopes<S>& slopes) const {
    const S end = S(half_[2]) * abs(slopes.along(axis(2)));
    if (at_.kind() == KernelShapeKind::capsule) return end + S(half_[0]) * sqrt(slopes.up2());
    return S(half_[0]) * abs(slopes.along(axis(0))) + S(half_[1]) * abs(slopes.along(axis(1))) + end;
  }

  /// Completes the result of `find`: where `far` is negative, computes it more exactly.
  [[gnu::noinline]] S with_closer_look(S far, const V3<S>& centre) const {
    const V3<S> axes[3] = {axis(0), axis(1), axis(2)};
    const double end = at_.kind() == KernelShapeKind::capsule ? half_[0] : 0;
    for (int i = 0; i < count_of<S>; ++i) {
      if (value_of(far, i) >= 0) continue;
      BoxOverTerrain box{{value_of(centre.x, i), value_of(centre.y, i), value_of(centre.z, i)},
                         {},
                         {half_[0], half_[1], half_[2] + end}};
      for (int k = 0; k < 3; ++k) {
        box.axes[k][0] = value_of(axes[k].x, i);
        box.axes[k][1] = value_of(axes[k].y, i);
        box.axes[k][2] = value_of(axes[k].z, i);
      }
      set_value(far, i, clearance_of(box));
    }
    return far;
  }
  /// Returns the clearance in any direction (m); -1: it may touch.
  MURO_INLINE double clearance_of(const BoxOverTerrain& box) const {
    const double beside = 0.25 * radius_;
    // if all sides of a box move out by a length, it covers at most 3^0.5 times that length beyond what it covered
    if (const double gap = clearance_below(grid_, box, beside); gap > 0)
      return gap < beside / 1.75 ? gap : beside / 1.75;
    return clearance_below(grid_, box, 0) > 0 ? 0 : -1;
  }

  const Shape& at_;
  const TerrainGrid& grid_;
  const double* const half_;
  const double radius_;
};

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
