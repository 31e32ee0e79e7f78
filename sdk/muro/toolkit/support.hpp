// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "muro/base/bounds.hpp"
#include "muro/base/elementary.hpp"

namespace muro {

/// The support function: distance (m) to which a shape extends from its middle along `direction` (unit, in the axes of
/// the shape). 0 for a mesh, infinite or NaN for a plane.
inline double support(const Shape& s, const Vec3& direction) {
  switch (s.kind) {
    case ShapeKind::sphere:
      return s.size.x();
    case ShapeKind::cylinder:
      return s.size.x() * elementary::hypot(direction.x(), direction.y()) + 0.5 * s.size.z() * std::abs(direction.z());
    case ShapeKind::capsule:
      return s.size.x() + 0.5 * s.size.z() * std::abs(direction.z());
    default:
      return direction.cwiseAbs().dot(half_extents(s));
  }
}

}  // namespace muro
