// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "mesh.hpp"

namespace muro::mesh {

/// A convex solid with flat faces.
struct Hull {
  struct Face {
    std::uint32_t first = 0;  ///< index in `corners`
    std::uint32_t count = 0;  ///< at least 3, counter-clockwise seen from outside
    Vec3 normal;              ///< unit, outward
    double offset = 0;        ///< m: the plane is normal . x = offset
  };
  std::vector<Vec3> vertices;  ///< m
  std::vector<Face> faces;
  std::vector<std::uint32_t> corners;  ///< numbers of vertices

  std::span<const std::uint32_t> corners_of(const Face& f) const { return {corners.data() + f.first, f.count}; }
};

/// Returns the smallest convex solid around all points (m), by Qhull (Barber, Dobkin and Huhdanpaa: The Quickhull
/// algorithm for convex hulls, ACM TOMS 1996). Faces whose planes differ by less than a millionth of the size are one
/// face. Throws muro::Error if the points lie in a plane. [setup]
Hull convex_hull(std::span<const Vec3> points);

/// Returns convex_hull() or, for points in a plane, the hull of a plate on both sides of it, a thousandth of their size
/// thick. Throws muro::Error if the points lie on a line. [setup]
Hull hull_or_plate(std::span<const Vec3> points);

/// Returns the surface of a hull: closed, facing outward.
Mesh surface_of(const Hull& hull);

}  // namespace muro::mesh
