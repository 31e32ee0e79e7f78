// SPDX-License-Identifier: MIT
// Shapes in the frame of a heightmap.
#pragma once

#include "kernel_shape.hpp"
#include "terrain_grid.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

template <class S>
MURO_INLINE V3<S> to_map(const TerrainGrid& grid, const V3<S>& v) {
  if (!grid.is_turned) return v;
  const double* const a = grid.axes;
  return {dot(lane::splat<S>(a), v), dot(lane::splat<S>(a + 3), v), dot(lane::splat<S>(a + 6), v)};
}
template <class S>
MURO_INLINE V3<S> to_world(const TerrainGrid& grid, const V3<S>& v) {
  if (!grid.is_turned) return v;
  const double* const a = grid.axes;
  return v.x * lane::splat<S>(a) + v.y * lane::splat<S>(a + 3) + v.z * lane::splat<S>(a + 6);
}

/// Returns the reach (m) of a shape from its centre.
MURO_INLINE double radius_of_all(KernelShapeKind kind, const double* half) {
  switch (kind) {
    case KernelShapeKind::sphere:
      return half[0];
    case KernelShapeKind::capsule:
      return half[0] + half[2];
    default:
      return __builtin_sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
  }
}
/// Returns how far (m) along x or y a ball with this centre and radius lies beyond the rim; negative if it does not lie
/// completely beyond.
template <class S>
MURO_INLINE S beyond_rim(const TerrainGrid& grid, const V3<S>& centre, double radius) {
  return max(abs(centre.x) - S(grid.half_x + radius), abs(centre.y) - S(grid.half_y + radius));
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
