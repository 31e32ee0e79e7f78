// SPDX-License-Identifier: MIT
// Points of a wheeled vehicle that stand on the ground.
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "muro/base/bounds.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/wheels/standing.hpp"
#include "wheel_finder.hpp"

namespace muro::wheels {

/// Returns the lowest point (m, in the frame of the base) of a wheel.
inline Vec3 lowest_point(const Wheel& w) { return w.centre - Vec3(0, 0, w.radius); }

namespace detail {

/// Returns points of a robot that may touch the ground beside its wheels: the lowest points of other collision shapes
/// in the frame of the base, with its joints at `positions`. A box has all its lower corners; meshes are omitted.
inline std::vector<Vec3> low_points(const Connector& c, const RobotView& robot, std::span<const double> positions,
                                    const std::vector<bool>& is_wheel) {
  std::vector<Pose> in_base(robot.links.size());
  std::vector<bool> on_wheel(robot.links.size());
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    if (i > 0) in_base[i] = in_base[std::size_t(link.parent)] * pose_in_parent(link, positions[i]);
    on_wheel[i] = is_wheel[i] || (i > 0 && on_wheel[std::size_t(link.parent)]);
    if (on_wheel[i]) continue;
    for (const Shape& s : c.constant_array(link.object, keys::collision_shapes)) {
      if (s.kind == ShapeKind::mesh || s.kind == ShapeKind::plane || s.kind == ShapeKind::heightmap) continue;
      const Aabb box = bounds_of(s, in_base[i] * s.origin);
      const Vec3 middle = 0.5 * (box.low + box.high);
      if (s.kind != ShapeKind::box)
        points.emplace_back(middle.x(), middle.y(), box.low.z());
      else
        for (const double x : {box.low.x(), box.high.x()})
          for (const double y : {box.low.y(), box.high.y()}) points.emplace_back(x, y, box.low.z());
    }
  }
  return points;
}

}  // namespace detail

/// Returns the lowest points of the wheels, in their order, each with weight 1. If they lie in a line (two wheels, or a
/// bicycle), points follow that support the line at its sides. These are as low as the wheels and have a weight that
/// leaves the wheels on the ground. They are the lowest of its other shapes, casters or the chassis, that reach down to
/// half a radius of the wheels above the ground. If there are none, they are two points beside the line, so that it
/// takes on the slope there. `all`: wheels with `link`, `lowest` and `radius`. [setup]
template <class StandingWheel>
std::vector<ground::ContactPoint> contact_points(const Connector& c, const RobotView& robot,
                                                 std::span<const StandingWheel> all,
                                                 std::span<const double> positions) {
  constexpr double beside = 1e-6;  // weight
  std::vector<ground::ContactPoint> points;
  std::vector<bool> is_wheel(robot.links.size());
  Vec3 middle = Vec3::Zero();
  double radius = 0;
  for (const StandingWheel& w : all) {
    points.push_back({w.lowest, 1});
    is_wheel[w.link] = true;
    middle += w.lowest / double(all.size());
    radius = std::max(radius, w.radius);
  }
  double xx = 0, xy = 0, yy = 0;
  for (const StandingWheel& w : all) {
    const Vec3 d = w.lowest - middle;
    xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
  }
  // the spread of the wheels along their line and across it: eigenvalues of their second moments
  const double mean = 0.5 * (xx + yy), half = std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  const double length = std::max(std::sqrt(mean + half), radius);
  if (mean - half > 0.01 * length * length) return points;
  const double least = mean - half;
  const Vec3 across = (xx > yy ? Vec3(xy, least - xx, 0) : Vec3(least - yy, xy, 0)).normalized();

  std::vector<Vec3> low = detail::low_points(c, robot, positions, is_wheel);
  std::erase_if(low, [&](const Vec3& p) {
    return p.z() > middle.z() + 0.5 * radius || std::abs(across.dot(p - middle)) < 0.1 * length;
  });
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : low) lowest = std::min(lowest, p.z());
  std::erase_if(low, [&](const Vec3& p) { return p.z() > lowest + 0.1 * radius; });
  if (low.empty()) low = {middle + length * across, middle - length * across};
  for (const Vec3& p : low) points.push_back({{p.x(), p.y(), middle.z()}, beside});
  return points;
}

}  // namespace muro::wheels
