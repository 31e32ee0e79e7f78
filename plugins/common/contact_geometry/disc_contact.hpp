// SPDX-License-Identifier: MIT
// Which contacts are points on the rim of a disc: the same four points may stand for a square.
#pragma once

#include <limits>

#include "muro/shape.hpp"

namespace muro::contact_geometry {

/// Of a shape for contacts.
struct ShapeExtent {
  double reach = 0;  ///< m: radius of a ball about it, of a cylinder that of its rim; infinite: not looked at
  bool is_cylinder = false;
  Vec3 rim = Vec3::Zero();  ///< m, in the frame of the link: axis of a cylinder, as long as its radius
};
inline ShapeExtent extent_of(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::box:
      return {0.5 * shape.size.norm()};
    case ShapeKind::sphere:
      return {shape.size.x()};
    case ShapeKind::cylinder:
      return {shape.size.x(), true, shape.origin.orientation * Vec3(0, 0, shape.size.x())};
    default:
      return {std::numeric_limits<double>::infinity()};
  }
}

/// Whether it is a disc that touches where the faces of two shapes do: the smaller one is a cylinder.
inline bool is_of_disc(const ShapeExtent& a, const ShapeExtent& b) {
  return a.reach <= b.reach ? a.is_cylinder : b.is_cylinder;
}

}  // namespace muro::contact_geometry
