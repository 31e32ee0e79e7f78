// SPDX-License-Identifier: MIT
#pragma once

#include "pairs/conversions.hpp"

namespace muro::native {

/// Distance that the first of two shapes must move along the unit vector n to be clear of the second:
///
///     h(n) = n . offset + sum_k half_k |n . axis_k| + sum_j radius_j |n x disc_j|      [+ ball]
///
/// This is the support function of the second shape minus the first (their Minkowski difference), because a box is the
/// sum of three segments, a cylinder of a segment and a disc, and a capsule of a segment and a ball. h is convex and
/// homogeneous. The shapes are apart if h(n) + ball <= 0 for some n. Otherwise the least h(n) + ball over all unit
/// vectors is the penetration depth.
/// h(n) + ball over all unit vectors is the penetration depth.
struct DepthFunction {
  const TransformedShape &first, &second;  ///< as given
  Vec3 offset;                             ///< m, from the centre of the first to that of the second
  Vec3 axis[4];
  double half[4];
  Vec3 disc[2];  ///< unit, axis of the disc
  double radius[2];
  double ball = 0;  ///< m; adds the same in every direction, so the search omits it
  int segments = 0, discs = 0;

  /// Takes boxes, cylinders and capsules; at most one of the two is a box.
  DepthFunction(const TransformedShape& a, const TransformedShape& b)
      : first(a), second(b), offset(b.centre - a.centre) {
    add(first);
    add(second);
  }

  /// Returns h(n), without the ball.
  double operator()(const Vec3& n) const {
    double h = n.dot(offset);
    for (int k = 0; k < segments; ++k) h += half[k] * std::abs(n.dot(axis[k]));
    for (int j = 0; j < discs; ++j) h += radius[j] * n.cross(disc[j]).norm();
    return h;
  }

  /// Returns the point of the difference (without the ball) that lies farthest along `n`, of any length but zero.
  Vec3 support(const Vec3& n) const {
    Vec3 p = offset;
    for (int k = 0; k < segments; ++k) p += std::copysign(half[k], n.dot(axis[k])) * axis[k];
    for (int j = 0; j < discs; ++j) {
      const Vec3 across = n - n.dot(disc[j]) * disc[j];
      const double length = across.norm();
      // Along the axis all points of the rim are equally far; `across` is then rounding and not at right angles to it.
      p += length > 1e-9 * n.norm() ? Vec3(across * (radius[j] / length)) : Vec3(radius[j] * perpendicular(disc[j]));
    }
    return p;
  }

 private:
  void add_segment(const Vec3& direction, double length) {
    axis[segments] = direction;
    half[segments++] = length;
  }
  void add(const TransformedShape& shape) {
    switch (shape.kind) {
      case ShapeKind::box:
        for (int k = 0; k < 3; ++k) add_segment(shape.axes.col(k), shape.half[k]);
        break;
      case ShapeKind::cylinder:
        disc[discs] = shape.axis();
        radius[discs++] = shape.radius();
        add_segment(shape.axis(), shape.half.z());
        break;
      case ShapeKind::capsule:
        ball += shape.radius();
        add_segment(shape.axis(), shape.half.z());
        break;
      default:
        break;
    }
  }
};

}  // namespace muro::native
