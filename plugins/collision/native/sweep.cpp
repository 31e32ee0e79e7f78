// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <algorithm>

#include "pairs/placed.hpp"

namespace muro::native {
namespace {

/// A box may grow by so much (its diagonal) on the way to a foremost frame.
constexpr double tolerable = 1.25;
/// Added to every side (m), so that rounding never lets a shape stand out of its box.
constexpr double rounding = 1e-9;

/// Half the extent of a cylinder with that axis (unit) along each axis of its frame.
Vec3 cylinder_reach(const Placed& c) {
  const Vec3 u = c.axis();
  return c.half.z() * u.cwiseAbs() + c.radius() * (1 - u.array().square()).max(0).sqrt().matrix();
}

/// The shape within its frame, less the ball that it is rounded with.
Vec3 core_of(const Placed& s) {
  switch (s.kind) {
    case ShapeKind::cylinder:
      return cylinder_reach(s);
    case ShapeKind::capsule:
      return s.half.z() * s.axis().cwiseAbs();
    case ShapeKind::box:
      return s.axes.cwiseAbs() * s.half;
    default:
      return Vec3::Zero();
  }
}
double ball_of(const Placed& s) {
  return s.kind == ShapeKind::sphere || s.kind == ShapeKind::capsule ? s.radius() : 0.0;
}
double diagonal_of(const Placed& s) { return (core_of(s) + Vec3::Constant(ball_of(s))).norm(); }

/// How far a shape whose centre is the origin reaches along and away from a line through it.
struct Reach {
  double along, away;
};
Reach reach_about(const Placed& s, const Vec3& line) {
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

/// The cylinder in which a shape stays while it turns about `axis` (unit, through the origin).
Placed turned_about(const Placed& s, const Vec3& axis) {
  const double height = axis.dot(s.centre), off = (s.centre - height * axis).norm();
  const Reach reach = reach_about(s, axis);
  Placed swept;
  swept.kind = ShapeKind::cylinder;
  swept.half = {off + reach.away, off + reach.away, reach.along};
  swept.centre = height * axis;
  swept.axes.col(0) = perpendicular(axis);
  swept.axes.col(1) = axis.cross(swept.axes.col(0));
  swept.axes.col(2) = axis;
  return swept;
}

}  // namespace

FrameBox swept_box(std::span<const Link> frames, const std::vector<bool>& follows, std::uint32_t frame,
                   const Shape& shape) {
  Placed s = placed(shape, shape.origin);
  const double most = tolerable * diagonal_of(s);
  for (; frames[frame].parent >= 0 && follows[frame]; frame = std::uint32_t(frames[frame].parent)) {
    const Link& f = frames[frame];
    if (f.joint == JointKind::prismatic) break;
    Placed next = f.joint == JointKind::revolute ? turned_about(s, f.axis) : s;
    const Mat3 turn = f.origin.orientation.toRotationMatrix();
    next.centre = f.origin.position + turn * next.centre;
    next.axes = turn * next.axes;
    if (diagonal_of(next) > most) break;
    s = next;
  }
  return {frame, s.centre, core_of(s) + Vec3::Constant(rounding), ball_of(s)};
}

std::vector<FrameBox> joined(std::vector<FrameBox> boxes) {
  std::stable_sort(boxes.begin(), boxes.end(), [](const FrameBox& a, const FrameBox& b) { return a.frame < b.frame; });
  std::vector<FrameBox> all;
  for (const FrameBox& b : boxes) {
    if (all.empty() || all.back().frame != b.frame) {
      all.push_back(b);
      continue;
    }
    FrameBox& a = all.back();
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

}  // namespace muro::native
