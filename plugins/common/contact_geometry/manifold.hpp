// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"

namespace muro::contact_geometry {

/// A point in which two shapes overlap.
struct ContactPoint {
  Vec3 point;    ///< m, world: half way between the two surfaces
  Vec3 normal;   ///< unit, world: from the second shape to the first, which is pushed along it
  double depth;  ///< m, > 0: overlap along the normal at this place
};

/// Points in which two shapes overlap; none when they are apart. The size is fixed, so it lives on the stack.
struct Manifold {
  static constexpr int capacity = 8;
  ContactPoint points[capacity];
  int count = 0;

  /// Adds a point. Points that do not fit are dropped; no pair test here has so many.
  void add(const Vec3& point, const Vec3& normal, double depth) {
    if (count < capacity) points[count++] = {point, normal, depth};
  }
  /// Exchanges first and second.
  void flip() {
    for (int i = 0; i < count; ++i) points[i].normal = -points[i].normal;
  }
};

}  // namespace muro::contact_geometry
