// SPDX-License-Identifier: MIT
#include "terrain.hpp"

#include <algorithm>
#include <string>

#include "muro/shape.hpp"
#include "muro/vocabulary.hpp"

namespace muro::ground {

namespace {

constexpr double least_upward = 0.1;  ///< cosine of the angle between the normal of a surface and the vertical

/// Returns the t at which a vertical line, `from` + t `up` in the frame of the map, meets a heightmap that is not
/// level. The line is cut with the plane of the triangle under the last cut, until the triangle stays the same.
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

Terrain::Tile::Tile(const Heightmap& m, const Pose& pose)
    : map(m), shape(pose), inverse(pose.inverse()), cells_per_x(1 / m.spacing_x()), cells_per_y(1 / m.spacing_y()) {
  const Mat3 axes = pose.orientation.toRotationMatrix();
  is_level = axes(2, 2) > 1 - 1e-15;
  cosine = axes(0, 0), sine = axes(1, 0);
}

/// Does the same as Heightmap::ground_at in few steps, because this is called more often than all else.
std::optional<Ground> Terrain::Tile::ground_of_level(double x, double y) const {
  const double dx = x - shape.position.x(), dy = y - shape.position.y();
  const double column = (cosine * dx + sine * dy + 0.5 * map.size.x()) * cells_per_x;
  const double row = (cosine * dy - sine * dx + 0.5 * map.size.y()) * cells_per_y;
  if (!(column >= 0 && row >= 0 && column <= map.columns - 1 && row <= map.rows - 1)) return std::nullopt;
  const auto c = std::min(std::uint32_t(column), map.columns - 2), r = std::min(std::uint32_t(row), map.rows - 2);
  const double u = column - c, v = row - r;
  const float* const low = map.values.data() + std::size_t(r) * map.columns + c;
  const float* const high = low + map.columns;
  const bool upper = u + v > 1;
  const double along = upper ? double(high[1]) - double(high[0]) : double(low[1]) - double(low[0]);
  const double across = upper ? double(high[1]) - double(low[1]) : double(high[0]) - double(low[0]);
  const double value =
      upper ? double(high[1]) - (1 - u) * along - (1 - v) * across : double(low[0]) + u * along + v * across;
  const double slope_x = map.size.z() * along * cells_per_x, slope_y = map.size.z() * across * cells_per_y;
  return Ground{shape.position.z() + map.size.z() * value, cosine * slope_x - sine * slope_y,
                sine * slope_x + cosine * slope_y};
}

std::optional<Ground> Terrain::Tile::ground_at(double x, double y) const {
  if (is_level) return ground_of_level(x, y);
  const Vec3 from = inverse * Vec3(x, y, 0), up = inverse.orientation * Vec3::UnitZ();
  Vec3 normal;
  const double t = cut(map, from, up, normal);
  const Vec3 at = from + t * up;
  if (!map.covers(at.x(), at.y())) return std::nullopt;
  const Vec3 in_world = shape.orientation * normal;
  return Ground{t, -in_world.x() / in_world.z(), -in_world.y() / in_world.z()};
}

std::optional<Ground> Terrain::ground_at(double x, double y) const {
  std::optional<Ground> highest;
  for (const Tile& tile : tiles_)
    if (const auto ground = tile.ground_at(x, y); ground && (!highest || ground->height > highest->height))
      highest = ground;
  for (const Plane& p : planes_) {
    const double slope_x = -p.normal.x() / p.normal.z(), slope_y = -p.normal.y() / p.normal.z();
    const double height = p.point.z() + slope_x * (x - p.point.x()) + slope_y * (y - p.point.y());
    if (!highest || height > highest->height) highest = Ground{height, slope_x, slope_y};
  }
  return highest;
}

void Terrain::add(const Connector& c, const ShapeOfObject& where, const Shape& shape, const Pose& pose) {
  const Vec3 normal = pose.orientation * Vec3::UnitZ();
  if ((shape.kind != ShapeKind::plane && shape.kind != ShapeKind::heightmap) || normal.z() < least_upward) return;
  shapes_.push_back(where);
  if (shape.kind == ShapeKind::plane) {
    planes_.push_back({pose.position, normal});
    return;
  }
  const Tile tile(files_.file(std::string(c.text(shape.mesh))).heightmap(shape.size), pose);
  resolution_ = std::min({resolution_, tile.map.spacing_x(), tile.map.spacing_y()});
  tiles_.push_back(tile);
}

void Terrain::connect(const Connector& c) {
  if (is_connected_) return;
  is_connected_ = true;
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) != no_robot) continue;
    const Pose body = c.constant(object, keys::pose).value_or(Pose{});
    ShapeOfObject where{object};
    for (const Shape& s : c.constant_array(object, keys::collision_shapes)) {
      add(c, where, s, body * s.origin);
      ++where.shape;
    }
  }
}

}  // namespace muro::ground
