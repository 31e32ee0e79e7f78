// SPDX-License-Identifier: MIT
#include "collision_object.hpp"
#include "muro/base/bounds.hpp"

#include <algorithm>

namespace muro::contact_geometry {
namespace {

using mesh::Hull;

/// Sets four corners of a face of a hull, in order around it: the farthest along `direction`, the one farthest from
/// that, and on each side of the line through both the one farthest from the line.
void set_corners(const Hull& hull, const Hull::Face& face, const Vec3& direction, const Pose& pose, Feature& f) {
  const std::span<const std::uint32_t> corners = hull.corners_of(face);
  const auto at = [&](std::size_t i) -> const Vec3& { return hull.vertices[corners[i]]; };
  std::size_t support = 0, far = 0;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (at(i).dot(direction) > at(support).dot(direction)) support = i;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if ((at(i) - at(support)).squaredNorm() > (at(far) - at(support)).squaredNorm()) far = i;
  const Vec3 across = face.normal.cross(at(far) - at(support));
  std::size_t right = support, left = support;
  double max_right = 0, max_left = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double side = across.dot(at(i) - at(support));
    if (side > max_right) max_right = side, right = i;
    if (side < max_left) max_left = side, left = i;
  }
  f.count = 4;
  f.points[0] = pose * at(support);
  f.points[2] = pose * at(far);
  // in a triangle, the middle of its longest side is the fourth corner
  const Vec3 middle = pose * Vec3(0.5 * (at(support) + at(far)));
  const bool nothing_left = max_left >= -1e-9 * max_right, nothing_right = max_right <= -1e-9 * max_left;
  f.points[1] = nothing_left ? middle : pose * at(left);
  f.points[3] = nothing_right ? middle : pose * at(right);
  if (nothing_left) {  // the first three points define the winding
    const Vec3 first = f.points[0];
    f.points[0] = f.points[2], f.points[1] = f.points[3], f.points[2] = first, f.points[3] = middle;
  }
}

Feature hull_face(const Hull& hull, const Pose& pose, const Vec3& towards) {
  const Vec3 direction = pose.orientation.conjugate() * towards;
  double farthest = -std::numeric_limits<double>::infinity(), second = farthest;
  std::uint32_t support = 0;
  for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
    const double out = hull.vertices[v].dot(direction);
    if (out > farthest) {
      second = farthest, farthest = out, support = v;
    } else {
      second = std::max(second, out);
    }
  }
  const Hull::Face* best = nullptr;  // among those about the support point
  for (const Hull::Face& f : hull.faces) {
    if (best && f.normal.dot(direction) <= best->normal.dot(direction)) continue;
    const std::span<const std::uint32_t> corners = hull.corners_of(f);
    if (std::find(corners.begin(), corners.end(), support) != corners.end()) best = &f;
  }
  Feature f;
  set_corners(hull, *best, direction, pose, f);
  f.normal = pose.orientation * best->normal;
  f.centre = 0.25 * (f.points[0] + f.points[1] + f.points[2] + f.points[3]);
  f.support = pose * hull.vertices[support];
  f.is_unique = farthest - second > 1e-7 * (f.points[2] - f.points[0]).norm();
  return f;
}

Feature plane_face(const CollisionObject& plane, const Vec3& centre, double reach) {
  const Vec3 n = plane.shape.axis(), x = plane.shape.axes.col(0), y = plane.shape.axes.col(1);
  Feature f;
  f.count = 4;
  f.normal = n;
  f.centre = f.support = centre - n.dot(centre - plane.shape.centre) * n;
  f.points[0] = f.centre + reach * (x + y);
  f.points[1] = f.centre + reach * (y - x);
  f.points[2] = f.centre - reach * (x + y);
  f.points[3] = f.centre + reach * (x - y);
  return f;
}

/// Returns the length of a vector with these components.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

CollisionObject collision_object(const CollisionGeometry& geometry, const Pose& pose) {
  CollisionObject s{&geometry, pose, {}};
  if (geometry.shape.kind != ShapeKind::mesh) {
    s.shape = transformed(geometry.shape, pose);
    return s;
  }
  s.shape = transformed(Shape::box(geometry.box.high - geometry.box.low),
                        pose * Pose{0.5 * (geometry.box.low + geometry.box.high), Quat::Identity()});
  s.shape.kind = ShapeKind::mesh;
  return s;
}

Feature feature_towards(const CollisionObject& s, const Vec3& direction, const Vec3& centre, double reach) {
  if (s.geometry->is_plane()) return plane_face(s, centre, reach);
  if (s.geometry->hull) return hull_face(*s.geometry->hull, s.pose, direction);
  return feature_towards(s.shape, direction);
}

Vec3 support_point(const CollisionObject& s, const Vec3& direction) {
  if (s.geometry->hull) {
    const Vec3 local = s.pose.orientation.conjugate() * direction;
    const Vec3* best = &s.geometry->hull->vertices.front();
    for (const Vec3& v : s.geometry->hull->vertices)
      if (v.dot(local) > best->dot(local)) best = &v;
    return s.pose * *best;
  }
  const TransformedShape& p = s.shape;
  if (p.kind == ShapeKind::sphere) return p.centre + p.radius() * direction;
  const Vec3 c = p.axes.transpose() * direction;
  if (p.kind == ShapeKind::box)
    return p.centre + p.axes * Vec3(std::copysign(p.half.x(), c.x()), std::copysign(p.half.y(), c.y()),
                                    std::copysign(p.half.z(), c.z()));
  const Vec3 end = p.centre + std::copysign(p.half.z(), c.z()) * p.axis();
  if (p.kind == ShapeKind::capsule) return end + p.radius() * direction;
  const double steep = c.head<2>().norm();
  if (!(steep > 0)) return end;
  return end + p.radius() / steep * (c.x() * p.axes.col(0) + c.y() * p.axes.col(1));
}

double signed_distance(const CollisionObject& s, const Vec3& point) {
  if (s.geometry->hull) {
    const Vec3 p = s.pose.inverse() * point;
    double height = -std::numeric_limits<double>::infinity();
    for (const mesh::Hull::Face& f : s.geometry->hull->faces) height = std::max(height, f.normal.dot(p) - f.offset);
    return height;
  }
  const Vec3 p = s.shape.axes.transpose() * (point - s.shape.centre);
  const double off = p.head<2>().norm(), r = s.shape.radius(), half = s.shape.half.z();
  switch (s.shape.kind) {
    case ShapeKind::sphere:
      return p.norm() - r;
    case ShapeKind::plane:
      return p.z();
    case ShapeKind::capsule:
      return length(off, std::max(0.0, std::abs(p.z()) - half)) - r;
    case ShapeKind::cylinder: {
      const double side = off - r, end = std::abs(p.z()) - half;
      return side > 0 && end > 0 ? length(side, end) : std::max(side, end);
    }
    default: {
      const Vec3 out = p.cwiseAbs() - s.shape.half;
      return out.maxCoeff() > 0 ? out.cwiseMax(0.0).norm() : out.maxCoeff();
    }
  }
}

double bounding_radius(const CollisionGeometry& geometry) {
  if (geometry.shape.kind == ShapeKind::mesh)
    return geometry.box.low.cwiseAbs().cwiseMax(geometry.box.high.cwiseAbs()).norm();
  if (geometry.is_plane()) return 0;
  return half_extents(geometry.shape).norm();
}

}  // namespace muro::contact_geometry
