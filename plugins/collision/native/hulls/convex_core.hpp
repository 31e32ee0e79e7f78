// SPDX-License-Identifier: MIT
#pragma once

#include "hulls/hull_support.hpp"
#include "pairs/conversions.hpp"

namespace muro::native {

/// A convex shape at a pose, without its rounding. The shape consists of all points within `ball` of the core.
struct ConvexCore {
  enum class Kind {
    point,     ///< core of a sphere
    segment,   ///< core of a capsule
    box,       //
    cylinder,  //
    hull,      //
    triangle,  //
  };
  Kind kind = Kind::point;
  double ball = 0;                    ///< m
  Vec3 centre = Vec3::Zero();         ///< m, world: a point of the core
  Mat3 axes = Mat3::Identity();       ///< in the world; not used for points and triangles
  Vec3 half = Vec3::Zero();           ///< m, half size of a box, segment (z) or cylinder
  const HullSupport* hull = nullptr;  ///< only of a hull
  Vec3 origin = Vec3::Zero();         ///< m, world: origin of a hull's frame
  Vec3 corners[3];                    ///< m, world: corners of a triangle

  /// Returns the core of a sphere, capsule, box or cylinder.
  static ConvexCore of(const TransformedShape& shape) {
    ConvexCore core;
    core.centre = shape.centre, core.axes = shape.axes, core.half = shape.half;
    switch (shape.kind) {
      case ShapeKind::box:
        core.kind = Kind::box;
        break;
      case ShapeKind::cylinder:
        core.kind = Kind::cylinder;
        break;
      case ShapeKind::capsule:
        core.kind = Kind::segment;
        core.ball = shape.radius();
        break;
      default:
        core.ball = shape.radius();
        break;
    }
    return core;
  }
  /// Returns the core of a hull whose frame is at `pose`. `inside` (m, world): a point of the hull.
  static ConvexCore of(const HullSupport& hull, const Pose& pose, const Vec3& inside) {
    ConvexCore core;
    core.kind = Kind::hull;
    core.centre = inside, core.axes = pose.orientation.toRotationMatrix();
    core.hull = &hull, core.origin = pose.position;
    return core;
  }
  static ConvexCore triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    ConvexCore core;
    core.kind = Kind::triangle;
    core.centre = (a + b + c) / 3;
    core.corners[0] = a, core.corners[1] = b, core.corners[2] = c;
    return core;
  }

  bool has_volume() const { return kind == Kind::box || kind == Kind::cylinder || kind == Kind::hull; }

  /// Returns the point of the core (m, world) that lies farthest along `n`. `n` may have any length but zero.
  Vec3 support(const Vec3& n) const {
    switch (kind) {
      case Kind::point:
        return centre;
      case Kind::segment:
        return centre + std::copysign(half.z(), axes.col(2).dot(n)) * axes.col(2);
      case Kind::box: {
        const Vec3 c = axes.transpose() * n;
        return centre + axes * Vec3(std::copysign(half.x(), c.x()), std::copysign(half.y(), c.y()),
                                    std::copysign(half.z(), c.z()));
      }
      case Kind::cylinder: {
        const Vec3 u = axes.col(2);
        const double along = n.dot(u);
        const Vec3 across = n - along * u, end = centre + std::copysign(half.z(), along) * u;
        const double steep = across.norm();
        // along the axis all points of the rim are equally far, so this takes one of them
        return steep > 1e-9 * n.norm() ? Vec3(end + across * (half.x() / steep)) : Vec3(end + half.x() * axes.col(0));
      }
      case Kind::hull:
        return origin + axes * (*hull)(axes.transpose() * n);
      case Kind::triangle:
        break;
    }
    const double a = corners[0].dot(n), b = corners[1].dot(n), c = corners[2].dot(n);
    return a >= b ? (a >= c ? corners[0] : corners[2]) : (b >= c ? corners[1] : corners[2]);
  }
};

/// Minkowski difference of two cores, second minus first. DepthFunction is the same for two primitives.
struct CorePair {
  const ConvexCore &first, &second;
  Vec3 offset;  ///< m, from a point of the first core to a point of the second
  double ball;  ///< m, of both together

  CorePair(const ConvexCore& a, const ConvexCore& b)
      : first(a), second(b), offset(b.centre - a.centre), ball(a.ball + b.ball) {}

  /// Returns the point of the difference that lies farthest along `n`. `n` may have any length but zero.
  Vec3 support(const Vec3& n) const { return second.support(n) - first.support(-n); }
};

}  // namespace muro::native
