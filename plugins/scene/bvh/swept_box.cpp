// SPDX-License-Identifier: MIT
#include "swept_box.hpp"

#include <algorithm>

#include "plugins/common/contact_geometry/transformed_shape.hpp"

namespace muro::bvh {

using namespace contact_geometry;

namespace {

/// Greatest factor by which the diagonal of a box may grow on the way towards the root.
constexpr double max_growth = 1.25;
/// Margin of every side (m), so that a shape is within its box in spite of rounding.
constexpr double rounding = 1e-9;

/// Returns half the extent of a cylinder along each axis of its link.
Vec3 cylinder_extent(const TransformedShape& c) {
  const Vec3 u = c.axis();
  return c.half.z() * u.cwiseAbs() + c.radius() * (1 - u.array().square()).max(0).sqrt().matrix();
}

/// Returns half the extent of the shape along each axis of its link, less the radius by which it is rounded.
Vec3 core_of(const TransformedShape& s) {
  switch (s.kind) {
    case ShapeKind::cylinder:
      return cylinder_extent(s);
    case ShapeKind::capsule:
      return s.half.z() * s.axis().cwiseAbs();
    case ShapeKind::box:
      return s.axes.cwiseAbs() * s.half;
    default:
      return Vec3::Zero();
  }
}
double ball_of(const TransformedShape& s) {
  return s.kind == ShapeKind::sphere || s.kind == ShapeKind::capsule ? s.radius() : 0.0;
}
double diagonal_of(const TransformedShape& s) { return (core_of(s) + Vec3::Constant(ball_of(s))).norm(); }

/// Extent of a shape along a line through its centre, and perpendicular to it.
struct Extent {
  double along, away;
};
Extent extent_about(const TransformedShape& s, const Vec3& line) {
  const double c = std::abs(s.axis().dot(line)), sine = std::sqrt(std::max(0.0, 1 - c * c));
  switch (s.kind) {
    case ShapeKind::cylinder:
      return {s.half.z() * c + s.radius() * sine, s.half.z() * sine + s.radius()};
    case ShapeKind::capsule:
      return {s.half.z() * c + s.radius(), s.half.z() * sine + s.radius()};
    case ShapeKind::box: {
      const Vec3 along = s.axes.transpose() * line;
      double away = 0;
      for (int corner = 0; corner < 4; ++corner) {
        const Vec3 p = s.axes * s.half.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, 1));
        away = std::max(away, (p - p.dot(line) * line).norm());
      }
      return {along.cwiseAbs().dot(s.half), away};
    }
    default:
      return {s.radius(), s.radius()};
  }
}

/// Returns the cylinder in which a shape stays while it rotates about `axis` (unit vector, through the origin).
TransformedShape revolved_about(const TransformedShape& s, const Vec3& axis) {
  const double height = axis.dot(s.centre), off = (s.centre - height * axis).norm();
  const Extent extent = extent_about(s, axis);
  TransformedShape swept;
  swept.kind = ShapeKind::cylinder;
  swept.half = {off + extent.away, off + extent.away, extent.along};
  swept.centre = height * axis;
  swept.axes.col(0) = perpendicular(axis);
  swept.axes.col(1) = axis.cross(swept.axes.col(0));
  swept.axes.col(2) = axis;
  return swept;
}

}  // namespace

LinkBox swept_box(Rows<Link> links, const std::vector<bool>& follows, std::uint32_t link, const Shape& shape) {
  TransformedShape s = transformed(shape, shape.origin);
  const double max_diagonal = max_growth * diagonal_of(s);
  for (; links[link].parent >= 0 && follows[link]; link = std::uint32_t(links[link].parent)) {
    const Link& l = links[link];
    if (l.joint == JointKind::prismatic) break;
    TransformedShape next = l.joint == JointKind::revolute ? revolved_about(s, l.axis) : s;
    const Mat3 rotation = l.origin.orientation.toRotationMatrix();
    next.centre = l.origin.position + rotation * next.centre;
    next.axes = rotation * next.axes;
    if (diagonal_of(next) > max_diagonal) break;
    s = next;
  }
  return {link, s.centre, core_of(s) + Vec3::Constant(rounding), ball_of(s)};
}

std::vector<LinkBox> merged(std::vector<LinkBox> boxes) {
  std::stable_sort(boxes.begin(), boxes.end(), [](const LinkBox& a, const LinkBox& b) { return a.link < b.link; });
  std::vector<LinkBox> all;
  for (const LinkBox& b : boxes) {
    if (all.empty() || all.back().link != b.link) {
      all.push_back(b);
      continue;
    }
    LinkBox& a = all.back();
    const double ball = std::min(a.ball, b.ball);
    const Vec3 reach_a = a.half + Vec3::Constant(a.ball - ball), reach_b = b.half + Vec3::Constant(b.ball - ball);
    const Vec3 low = (a.centre - reach_a).cwiseMin(b.centre - reach_b),
               high = (a.centre + reach_a).cwiseMax(b.centre + reach_b);
    a.centre = 0.5 * (low + high);
    a.half = 0.5 * (high - low);
    a.ball = ball;
  }
  return all;
}

}  // namespace muro::bvh
