// SPDX-License-Identifier: MIT
#pragma once

#include "hulls/convex_core.hpp"
#include "plugins/common/contact_geometry/collision_object.hpp"

namespace muro::native {

using namespace contact_geometry;

/// A convex shape in the frame of a heightmap.
struct Solid {
  TransformedShape shape;                   ///< of a hull: the box around it
  const CollisionGeometry* hull = nullptr;  ///< null: not a hull
  Pose pose;                                ///< only of a hull
  ConvexCore core;

  /// Makes a solid of arguments in the world. `frame`: of the heightmap.
  Solid(const TransformedShape& in_world, const Pose& frame);
  Solid(const TransformedShape& box, const CollisionGeometry& of_hull, const HullSupport& support, const Pose& at,
        const Pose& frame);

  contact_geometry::Feature feature_towards(const Vec3& direction) const;
  /// A way out of the solid from a point in it, through one of its faces or its round side.
  struct WayOut {
    Vec3 normal;   ///< unit, into the solid: the solid is pushed off the point along it
    double depth;  ///< m, positive for points in the solid
  };
  /// Calls `visit(way)` for each way out.
  template <class Visit>
  void each_way_out(const Vec3& point, Visit visit) const {
    const Vec3 d = point - shape.centre;
    const auto round = [&](const Vec3& off) {
      const double distance = off.norm();
      if (distance > 0) visit(WayOut{-off / distance, shape.radius() - distance});
    };
    if (hull) {
      const Vec3 local = pose.inverse() * point;
      for (const mesh::Hull::Face& f : hull->hull->faces)
        visit(WayOut{-(pose.orientation * f.normal), f.offset - f.normal.dot(local)});
      return;
    }
    const Vec3 u = shape.axis();
    const double along = u.dot(d);
    switch (shape.kind) {
      case ShapeKind::sphere:
        return round(d);
      case ShapeKind::capsule:
        return round(d - std::clamp(along, -shape.half.z(), shape.half.z()) * u);
      case ShapeKind::cylinder:
        round(d - along * u);
        visit(WayOut{-u, shape.half.z() - along});
        visit(WayOut{u, shape.half.z() + along});
        return;
      default:
        for (int k = 0; k < 3; ++k) {
          const double at = shape.axes.col(k).dot(d);
          visit(WayOut{-shape.axes.col(k), shape.half[k] - at});
          visit(WayOut{shape.axes.col(k), shape.half[k] + at});
        }
        return;
    }
  }
};

}  // namespace muro::native
