// SPDX-License-Identifier: MIT
#include "solid.hpp"

#include <algorithm>

namespace muro::encounters {
namespace {

using mesh::Hull;

/// Four of the corners of a face of a hull, in order around it: the outermost along `direction`, the one farthest from
/// that, and of those on either side of the line through both the one farthest from it.
void take_corners(const Hull& hull, const Hull::Face& face, const Vec3& direction, const Pose& pose, Feature& f) {
  const std::span<const std::uint32_t> corners = hull.corners_of(face);
  const auto at = [&](std::size_t i) -> const Vec3& { return hull.vertices[corners[i]]; };
  std::size_t tip = 0, far = 0;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (at(i).dot(direction) > at(tip).dot(direction)) tip = i;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if ((at(i) - at(tip)).squaredNorm() > (at(far) - at(tip)).squaredNorm()) far = i;
  const Vec3 across = face.normal.cross(at(far) - at(tip));
  std::size_t right = tip, left = tip;
  double most_right = 0, most_left = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double side = across.dot(at(i) - at(tip));
    if (side > most_right) most_right = side, right = i;
    if (side < most_left) most_left = side, left = i;
  }
  f.count = 4;
  f.points[0] = pose * at(tip);
  f.points[2] = pose * at(far);
  // a triangle: the middle of its longest side stands in for the fourth corner
  const Vec3 middle = pose * Vec3(0.5 * (at(tip) + at(far)));
  const bool none_left = most_left >= -1e-9 * most_right, none_right = most_right <= -1e-9 * most_left;
  f.points[1] = none_left ? middle : pose * at(left);
  f.points[3] = none_right ? middle : pose * at(right);
  if (none_left) {  // the first three points tell which way round it goes
    const Vec3 first = f.points[0];
    f.points[0] = f.points[2], f.points[1] = f.points[3], f.points[2] = first, f.points[3] = middle;
  }
}

Feature hull_face(const Hull& hull, const Pose& pose, const Vec3& towards) {
  const Vec3 direction = pose.orientation.conjugate() * towards;
  const Hull::Face* best = &hull.faces.front();
  for (const Hull::Face& f : hull.faces)
    if (f.normal.dot(direction) > best->normal.dot(direction)) best = &f;
  double farthest = -std::numeric_limits<double>::infinity(), second = farthest;
  const Vec3* tip = nullptr;
  for (const Vec3& v : hull.vertices) {
    const double out = v.dot(direction);
    if (out > farthest) {
      second = farthest, farthest = out, tip = &v;
    } else {
      second = std::max(second, out);
    }
  }
  Feature f;
  take_corners(hull, *best, direction, pose, f);
  f.normal = pose.orientation * best->normal;
  f.centre = 0.25 * (f.points[0] + f.points[1] + f.points[2] + f.points[3]);
  f.tip = pose * *tip;
  f.sharp = farthest - second > 1e-7 * (f.points[2] - f.points[0]).norm();
  return f;
}

Feature plane_face(const Standing& plane, const Vec3& centre, double reach) {
  const Vec3 n = plane.placed.axis(), x = plane.placed.axes.col(0), y = plane.placed.axes.col(1);
  Feature f;
  f.count = 4;
  f.normal = n;
  f.centre = f.tip = centre - n.dot(centre - plane.placed.centre) * n;
  f.points[0] = f.centre + reach * (x + y);
  f.points[1] = f.centre + reach * (y - x);
  f.points[2] = f.centre - reach * (x + y);
  f.points[3] = f.centre + reach * (x - y);
  return f;
}

}  // namespace

Standing standing(const Solid& solid, const Pose& pose) {
  Standing s{&solid, pose, {}};
  if (solid.shape.kind == ShapeKind::mesh)
    s.placed = placed(Shape::box(solid.box.high - solid.box.low),
                      pose * Pose{0.5 * (solid.box.low + solid.box.high), Quat::Identity()});
  else
    s.placed = placed(solid.shape, pose);
  return s;
}

Feature feature_towards(const Standing& s, const Vec3& direction, const Vec3& centre, double reach) {
  if (s.solid->is_plane()) return plane_face(s, centre, reach);
  if (s.solid->hull) return hull_face(*s.solid->hull, s.pose, direction);
  return feature_towards(s.placed, direction);
}

Vec3 outermost(const Standing& s, const Vec3& direction) {
  if (s.solid->hull) {
    const Vec3 local = s.pose.orientation.conjugate() * direction;
    const Vec3* best = &s.solid->hull->vertices.front();
    for (const Vec3& v : s.solid->hull->vertices)
      if (v.dot(local) > best->dot(local)) best = &v;
    return s.pose * *best;
  }
  const Placed& p = s.placed;
  if (p.kind == ShapeKind::sphere) return p.centre + p.radius() * direction;
  const Vec3 c = p.axes.transpose() * direction;
  if (p.kind == ShapeKind::box)
    return p.centre + p.axes * Vec3(std::copysign(p.half.x(), c.x()), std::copysign(p.half.y(), c.y()),
                                    std::copysign(p.half.z(), c.z()));
  const Vec3 end = p.centre + std::copysign(p.half.z(), c.z()) * p.axis();
  if (p.kind == ShapeKind::capsule) return end + p.radius() * direction;
  const double steep = std::hypot(c.x(), c.y());
  if (!(steep > 0)) return end;
  return end + p.radius() / steep * (c.x() * p.axes.col(0) + c.y() * p.axes.col(1));
}

double height_over(const Standing& s, const Vec3& point) {
  if (s.solid->hull) {
    const Vec3 p = s.pose.inverse() * point;
    double height = -std::numeric_limits<double>::infinity();
    for (const mesh::Hull::Face& f : s.solid->hull->faces) height = std::max(height, f.normal.dot(p) - f.offset);
    return height;
  }
  const Vec3 p = s.placed.axes.transpose() * (point - s.placed.centre);
  const double off = std::hypot(p.x(), p.y()), r = s.placed.radius(), half = s.placed.half.z();
  switch (s.placed.kind) {
    case ShapeKind::sphere:
      return p.norm() - r;
    case ShapeKind::plane:
      return p.z();
    case ShapeKind::capsule:
      return std::hypot(off, std::max(0.0, std::abs(p.z()) - half)) - r;
    case ShapeKind::cylinder: {
      const double side = off - r, end = std::abs(p.z()) - half;
      return side > 0 && end > 0 ? std::hypot(side, end) : std::max(side, end);
    }
    default: {
      const Vec3 out = p.cwiseAbs() - s.placed.half;
      return out.maxCoeff() > 0 ? out.cwiseMax(0.0).norm() : out.maxCoeff();
    }
  }
}

double reach_of(const Solid& solid) {
  if (solid.shape.kind == ShapeKind::mesh) return solid.box.low.cwiseAbs().cwiseMax(solid.box.high.cwiseAbs()).norm();
  if (solid.is_plane()) return 0;
  return half_extents(solid.shape).norm();
}

}  // namespace muro::encounters
