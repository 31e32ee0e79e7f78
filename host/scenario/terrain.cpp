// SPDX-License-Identifier: MIT
#include "host/scenario/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr double least_upward = 0.1;  ///< cosine of the angle between a surface and the vertical

/// A cell of a heightmap; `u` and `v` go from 0 to 1 along x and y.
struct CellHeights {
  double low, right, left, high;  ///< m, of its corners -x -y, +x -y, -x +y and +x +y

  double at(double u, double v) const {
    return u + v <= 1 ? low + u * (right - low) + v * (left - low)
                      : high + (1 - u) * (left - high) + (1 - v) * (right - high);
  }
  /// The highest of its corners, and of the points where its diagonal leaves, in a part of the cell.
  double highest(double u0, double u1, double v0, double v1) const {
    double most = std::max({at(u0, v0), at(u1, v0), at(u0, v1), at(u1, v1)});
    for (const double u : {u0, u1})
      if (1 - u > v0 && 1 - u < v1) most = std::max(most, at(u, 1 - u));
    for (const double v : {v0, v1})
      if (1 - v > u0 && 1 - v < u1) most = std::max(most, at(1 - v, v));
    return most;
  }
};

/// m: the highest point of the surface under or over a box, in the frame of the map.
std::optional<double> highest(const Heightmap& map, const Aabb& box) {
  const double half_x = 0.5 * map.size.x(), half_y = 0.5 * map.size.y();
  const double x0 = std::max(box.low.x(), -half_x), x1 = std::min(box.high.x(), half_x);
  const double y0 = std::max(box.low.y(), -half_y), y1 = std::min(box.high.y(), half_y);
  if (!(x0 <= x1) || !(y0 <= y1)) return std::nullopt;
  const Heightmap::Cell first = map.cell_at(x0, y0), last = map.cell_at(x1, y1);
  const double sx = map.spacing_x(), sy = map.spacing_y();
  double most = -std::numeric_limits<double>::infinity();
  for (std::uint32_t row = first.row; row <= last.row; ++row)
    for (std::uint32_t column = first.column; column <= last.column; ++column) {
      const CellHeights cell{map.node(column, row).z(), map.node(column + 1, row).z(), map.node(column, row + 1).z(),
                             map.node(column + 1, row + 1).z()};
      const auto part = [](double at, double half, double spacing, std::uint32_t number) {
        return std::clamp((at + half) / spacing - number, 0.0, 1.0);
      };
      most = std::max(most, cell.highest(part(x0, half_x, sx, column), part(x1, half_x, sx, column),
                                         part(y0, half_y, sy, row), part(y1, half_y, sy, row)));
    }
  return most;
}

/// Calls visit(shape) for each collision shape of a link.
template <class Visit>
void each_shape(const RobotTree& tree, const RobotTree::FlatLink& link, Visit visit) {
  for (const RobotTree::Constant& c : tree.components()[std::size_t(link.body)].constants) {
    if (c.key.name != keys::collision_shapes.name) continue;
    for (std::uint32_t i = 0; i < c.count; ++i) {
      Shape s;
      std::memcpy(static_cast<void*>(&s), c.data.data() + i * sizeof(Shape), sizeof(Shape));
      visit(std::as_const(s));
    }
  }
}

}  // namespace

std::string link_with_heightmap(const RobotTree& tree) {
  for (const RobotTree::FlatLink& f : tree.links()) {
    bool any = false;
    each_shape(tree, f, [&](const Shape& s) { any = any || s.kind == ShapeKind::heightmap; });
    if (any) return tree.components()[std::size_t(f.body)].name;
  }
  return "";
}

std::vector<StandingShape> standing_shapes(const RobotTree& tree, std::span<const double> positions) {
  std::vector<StandingShape> all;
  std::vector<Pose> poses;
  for (const RobotTree::FlatLink& f : tree.links()) {
    const Pose in_parent = f.link.parent < 0 ? Pose{} : pose_in_parent(f.link, positions[poses.size()]);
    poses.push_back(f.link.parent < 0 ? Pose{} : poses[std::size_t(f.link.parent)] * in_parent);
    each_shape(tree, f, [&](const Shape& s) {
      if (s.kind == ShapeKind::plane) return;
      all.push_back({s, s.kind == ShapeKind::mesh ? std::string(tree.texts()[s.mesh]) : "", poses.back() * s.origin});
    });
  }
  return all;
}

void Terrain::add(const Shape& shape, const std::string& file, const Pose& pose) {
  if ((pose.orientation * Vec3::UnitZ()).z() < least_upward) return;
  if (shape.kind == ShapeKind::plane) planes_.push_back(pose);
  if (shape.kind == ShapeKind::heightmap) tiles_.push_back({file, shape.size, pose});
}

void Terrain::add_scenery(const World& world) {
  for (std::uint32_t i = 1; i < world.object_count(); ++i) {
    const ObjectId object{i};
    if (world.robot_of(object) >= 0) continue;
    const ArrayHeader poses = world.store().constant(object, keys::pose);
    const ArrayHeader shapes = world.store().constant(object, keys::collision_shapes);
    if (!poses.data || !shapes.data) continue;
    for (const Shape& s : std::span(static_cast<const Shape*>(shapes.data), shapes.size))
      add(s, s.kind == ShapeKind::heightmap ? std::string(world.text(s.mesh)) : "",
          *static_cast<const Pose*>(poses.data) * s.origin);
  }
}

/// By how much (m) the shape of what stands at `at` must be raised to touch the surface from above; less than 0: may be
/// lowered. Upwards is aslant in the frame of a map that is tilted, so that the shape comes over other cells.
std::optional<double> Terrain::rise(const Tile& tile, const StandingShape& shape, const Pose& at) {
  const Heightmap map = files_.heightmaps.of(tile.file, tile.size);
  const Pose in_map = tile.pose.inverse() * (at * shape.pose);
  const Vec3 up = tile.pose.orientation.conjugate() * Vec3::UnitZ();
  double raised = 0;
  for (int i = 0; i < 30; ++i) {
    const Aabb box =
        files_.meshes.bounds_of(shape.shape, shape.mesh, {Vec3(in_map.position + raised * up), in_map.orientation});
    const std::optional<double> surface = highest(map, box);
    if (!surface) return std::nullopt;
    const double missing = (*surface - box.low.z()) / up.z();
    raised += missing;
    if (std::abs(missing) < 1e-9 || up.z() > 1 - 1e-12) break;
  }
  return raised;
}

std::optional<double> Terrain::height(std::span<const StandingShape> shapes, const Pose& at) {
  Pose pose = at;
  pose.position.z() = 0;
  std::optional<double> most;
  const auto take = [&](const std::optional<double>& rise) {
    if (rise && (!most || *rise > *most)) most = rise;
  };
  for (const StandingShape& s : shapes) {
    for (const Tile& tile : tiles_) take(rise(tile, s, pose));
    for (const Pose& plane : planes_) {
      const Aabb box = files_.meshes.bounds_of(s.shape, s.mesh, plane.inverse() * (pose * s.pose));
      take(-box.low.z() / (plane.orientation * Vec3::UnitZ()).z());
    }
  }
  return most;
}

}  // namespace muro::host
