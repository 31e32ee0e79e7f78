// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/scene.hpp"

namespace muro {

/// Returns the box around points (m) at `pose`, after scaling along their axes. Without points it is a box of size 0 at
/// the position of `pose`.
inline Aabb bounds_of_points(std::span<const Vec3> points, const Vec3& scale, const Pose& pose) {
  Aabb box;
  for (const Vec3& p : points) {
    const Vec3 at = pose * Vec3(p.cwiseProduct(scale));
    box.include({at, at});
  }
  return points.empty() ? Aabb{pose.position, pose.position} : box;
}

}  // namespace muro
