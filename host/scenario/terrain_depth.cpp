// SPDX-License-Identifier: MIT
#include "host/scenario/terrain_depth.hpp"

#include <algorithm>
#include <limits>

namespace muro::host {

namespace {

double depth_of(const Heightmap& map, const Vec3& point) {
  const std::optional<Heightmap::Ground> ground = map.ground_at(point.x(), point.y());
  if (!ground) return -std::numeric_limits<double>::infinity();
  return (ground->height - point.z()) * ground->normal.z();
}

/// Returns the point of a round shape, in its own frame, that is furthest along `direction` (unit).
Vec3 furthest(const Shape& s, const Vec3& direction) {
  const double half = s.kind == ShapeKind::sphere ? 0 : std::copysign(0.5 * s.size.z(), direction.z());
  if (s.kind != ShapeKind::cylinder) return Vec3(0, 0, half) + s.size.x() * direction;
  Vec3 radial(direction.x(), direction.y(), 0);
  if (radial.norm() > 1e-9) radial *= s.size.x() / radial.norm();
  return radial + Vec3(0, 0, half);
}

}  // namespace

double depth_below(const Heightmap& map, const Pose& in_map, const Shape& shape, std::span<const Vec3> corners) {
  double deepest = -std::numeric_limits<double>::infinity();
  const auto take = [&](const Vec3& point) { deepest = std::max(deepest, depth_of(map, in_map * point)); };
  switch (shape.kind) {
    case ShapeKind::box:
      for (int i = 0; i < 8; ++i)
        take(0.5 * shape.size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
      break;
    case ShapeKind::mesh:
      for (const Vec3& corner : corners) take(shape.size.cwiseProduct(corner));
      break;
    case ShapeKind::sphere:
    case ShapeKind::cylinder:
    case ShapeKind::capsule: {
      const auto below = map.ground_at(in_map.position.x(), in_map.position.y());
      const Vec3 normal = below ? below->normal : Vec3(Vec3::UnitZ());
      for (const Vec3& direction : {normal, Vec3(Vec3::UnitZ())})
        take(furthest(shape, in_map.orientation.conjugate() * Vec3(-direction)));
      break;
    }
    case ShapeKind::plane:
    case ShapeKind::heightmap:
      break;
  }
  return deepest;
}

}  // namespace muro::host
