// SPDX-License-Identifier: MIT
// Decides which contacts are points on the rim of a disc. The same four points may also be those of a square.
#pragma once

#include <limits>

#include "muro/shape.hpp"

namespace muro::contact_geometry {

/// Size of a shape, for contacts.
struct ShapeExtent {
  double reach = 0;  ///< m: radius of a ball about it; cylinder: radius of its rim; infinite: not considered
  bool is_cylinder = false;
  Vec3 rim = Vec3::Zero();  ///< m, in the frame of the link: axis of a cylinder, its length is the radius
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

/// Whether a disc touches where the faces of two shapes touch: the smaller shape is a cylinder.
inline bool is_of_disc(const ShapeExtent& a, const ShapeExtent& b) {
  return a.reach <= b.reach ? a.is_cylinder : b.is_cylinder;
}

}  // namespace muro::contact_geometry
