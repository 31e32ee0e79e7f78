// SPDX-License-Identifier: MIT
#include "sole.hpp"

#include <limits>

#include "muro/toolkit/rotations.hpp"

namespace muro::biped {

namespace {

constexpr double same_place = 1e-9;  ///< m
constexpr int corners_of_rim = 16;

/// Returns corners that represent the points in the search for the side: a ball is represented by its lowest point.
std::vector<Vec3> corners_of(const std::vector<SolePoint>& points, const Vec3& down) {
  std::vector<Vec3> corners;
  for (const SolePoint& p : points) {
    const Vec3 center = p.center + p.radius * down;
    if (p.rim == 0) {
      corners.push_back(center);
      continue;
    }
    const Quat turn = turn_between(Vec3::UnitZ(), p.axis);
    for (int i = 0; i < corners_of_rim; ++i) {
      const auto [sine, cosine] = elementary::sincos(2 * M_PI * i / corners_of_rim);
      corners.push_back(center + turn * Vec3(p.rim * cosine, p.rim * sine, 0));
    }
  }
  return corners;
}

/// The corner that a plane touches next when it turns about the corners that it touches, and the angle of that turn
/// (rad).
struct Touch {
  double angle = std::numeric_limits<double>::infinity();
  Vec3 corner = Vec3::Zero();
};

}  // namespace

Sole::Sole(std::vector<SolePoint> points, const Vec3& down) : points_(std::move(points)), normal_(down) {
  const std::vector<Vec3> corners = corners_of(points_, down);
  Vec3 first = corners.front();
  for (const Vec3& p : corners)
    if (p.dot(down) > first.dot(down)) first = p;
  // turn about the first corner to a second one
  Touch second;
  for (const Vec3& p : corners) {
    const Vec3 arm = p - first, level = arm - arm.dot(down) * down;
    if (arm.norm() < same_place) continue;
    const double angle = elementary::atan2(-arm.dot(down), level.norm());
    if (angle < second.angle) second = {angle, p};
  }
  if (!(second.angle < std::numeric_limits<double>::infinity())) return;
  edge_ = (second.corner - first).normalized();
  const Vec3 tipped = down - down.dot(edge_) * edge_;
  if (tipped.norm() < same_place) {  // the sole is a line along `down`
    side_ = Side::edge;
    normal_ = edge_.unitOrthogonal();
    return;
  }
  normal_ = tipped.normalized();
  side_ = Side::edge;
  // turn about this edge to a third one, to either side
  const Vec3 across = edge_.cross(normal_);
  Touch third;
  for (const Vec3& p : corners) {
    const Vec3 arm = p - first;
    const double aside = arm.dot(across);
    if ((arm - arm.dot(edge_) * edge_).norm() < same_place) continue;
    const double angle = elementary::atan2(-arm.dot(normal_), std::abs(aside));
    if (angle < third.angle) third = {angle, p};
  }
  if (!(third.angle < std::numeric_limits<double>::infinity())) return;
  side_ = Side::face;
  const Vec3 arm = third.corner - first, normal = edge_.cross(arm - arm.dot(edge_) * edge_).normalized();
  const auto is_outside = [&](const Vec3& p) { return normal.dot(p - first) > same_place; };
  const auto is_inside = [&](const Vec3& p) { return normal.dot(p - first) < -same_place; };
  const bool above = std::any_of(corners.begin(), corners.end(), is_inside);
  const bool below = std::any_of(corners.begin(), corners.end(), is_outside);
  const bool is_outward = above == below ? normal.dot(normal_) > 0 : above;
  normal_ = is_outward ? normal : Vec3(-normal);
}

Vec3 Sole::lowest_point(const Vec3& up) const {
  const SolePoint* lowest = &points_.front();
  double least = std::numeric_limits<double>::infinity();
  for (const SolePoint& p : points_) {
    const double height = up.dot(p.center) - reach(p, up);
    if (height < least) least = height, lowest = &p;
  }
  Vec3 point = lowest->center - lowest->radius * up;
  if (lowest->rim > 0) {
    const Vec3 outward = up - up.dot(lowest->axis) * lowest->axis;
    if (outward.norm() > 1e-12) point -= lowest->rim * outward.normalized();
  }
  return point;
}

Quat Sole::flush_turn(const Quat& foot, const Vec3& normal) const {
  if (side_ == Side::face) return turn_between(foot * normal_, -normal);
  if (side_ == Side::none) return Quat::Identity();
  const Vec3 edge = foot * edge_, level = edge - edge.dot(normal) * normal;
  return turn_between(edge, level.norm() > 1e-9 ? Vec3(level.normalized()) : Vec3(edge.unitOrthogonal()));
}

}  // namespace muro::biped
