// SPDX-License-Identifier: MIT
#include "terrain.hpp"

#include <algorithm>
#include <string>

#include "muro/shape.hpp"
#include "muro/vocabulary.hpp"

namespace muro::ground {

namespace {

constexpr double least_upward = 0.1;  ///< cosine of the angle between a surface and the vertical

/// Where a vertical line meets a heightmap that is not level: `from` + t `up`, in the frame of the map. The line is cut
/// with the plane of the triangle that is under the last cut, until that is the same one.
double cut(const Heightmap& map, const Vec3& from, const Vec3& up, Vec3& normal) {
  double t = -from.z() / up.z();
  for (int i = 0; i < 32; ++i) {
    const Vec3 at = from + t * up;
    const Heightmap::Cell cell = map.cell_at(at.x(), at.y());
    const Heightmap::Triangle triangle = map.triangle(cell, map.is_upper(cell, at.x(), at.y()));
    normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
    const double steepness = normal.dot(up);
    if (steepness < least_upward) break;  // an overhang
    const double next = normal.dot(triangle[0] - from) / steepness;
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace

std::optional<Heightmap::Ground> Terrain::Tile::ground_at(double x, double y) const {
  const Vec3 from = inverse * Vec3(x, y, 0);
  if (is_level) {
    std::optional<Heightmap::Ground> ground = map.ground_at(from.x(), from.y());
    if (!ground) return ground;
    return Heightmap::Ground{shape.position.z() + ground->height, shape.orientation * ground->normal};
  }
  const Vec3 up = inverse.orientation * Vec3::UnitZ();
  Vec3 normal;
  const double t = cut(map, from, up, normal);
  const Vec3 at = from + t * up;
  if (!map.covers(at.x(), at.y())) return std::nullopt;
  return Heightmap::Ground{t, shape.orientation * normal};
}

std::optional<Heightmap::Ground> Terrain::ground_at(double x, double y) const {
  std::optional<Heightmap::Ground> highest;
  for (const Tile& tile : tiles_)
    if (const auto ground = tile.ground_at(x, y); ground && (!highest || ground->height > highest->height))
      highest = ground;
  for (const Plane& p : planes_) {
    const double height =
        p.point.z() - (p.normal.x() * (x - p.point.x()) + p.normal.y() * (y - p.point.y())) / p.normal.z();
    if (!highest || height > highest->height) highest = Heightmap::Ground{height, p.normal};
  }
  return highest;
}

void Terrain::add(const Connector& c, ObjectId object, const Shape& shape, const Pose& pose) {
  const Vec3 normal = pose.orientation * Vec3::UnitZ();
  if ((shape.kind != ShapeKind::plane && shape.kind != ShapeKind::heightmap) || normal.z() < least_upward) return;
  if (objects_.empty() || objects_.back() != object) objects_.push_back(object);
  if (shape.kind == ShapeKind::plane) {
    planes_.push_back({pose.position, normal});
    return;
  }
  Tile tile{{}, pose, pose.inverse(), normal.z() > 1 - 1e-15};
  tile.map = files_.file(std::string(c.text(shape.mesh))).heightmap(shape.size);
  resolution_ = std::min({resolution_, tile.map.spacing_x(), tile.map.spacing_y()});
  tiles_.push_back(tile);
}

void Terrain::connect(const Connector& c) {
  if (is_connected_) return;
  is_connected_ = true;
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) >= 0) continue;
    const Pose body = c.constant(object, keys::pose).value_or(Pose{});
    for (const Shape& s : c.constant_array(object, keys::collision_shapes)) add(c, object, s, body * s.origin);
  }
}

}  // namespace muro::ground
