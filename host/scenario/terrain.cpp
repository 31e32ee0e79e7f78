// SPDX-License-Identifier: MIT
#include "host/scenario/terrain.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr double least_upward = 0.1;  ///< cosine of the angle between a surface and the vertical

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

/// m: the lowest and the highest height of a map, in its frame.
std::array<double, 2> Terrain::heights_of(const Tile& tile) {
  const auto known = heights_.find(tile.file);
  if (known != heights_.end()) return {tile.size.z() * known->second[0], tile.size.z() * known->second[1]};
  const Heightmap map = files_.heightmaps.of(tile.file, tile.size);
  const auto [low, high] = std::minmax_element(map.values.begin(), map.values.end());
  heights_[tile.file] = {double(*low), double(*high)};
  return heights_of(tile);
}

/// The part of a tile, in its frame, that is above or below a box of the world. Upwards is aslant in the frame of a map
/// that is tilted.
Aabb Terrain::part_near(const Tile& tile, const ConvexBottom& bottom) {
  const Quat to_map = tile.pose.orientation.conjugate();
  const Vec3 up = to_map * Vec3::UnitZ();
  const bool is_tilted = up.z() < 1 - 1e-12;
  const std::array<double, 2> heights = is_tilted ? heights_of(tile) : std::array{0.0, 0.0};
  Aabb part;
  for (const double x : {bottom.low(0), bottom.high(0)})
    for (const double y : {bottom.low(1), bottom.high(1)})
      for (const double z : heights) {
        const Vec3 p = to_map * Vec3(Vec3(x, y, 0) - tile.pose.position);
        const Vec3 at = is_tilted ? Vec3(p + (z - p.z()) / up.z() * up) : p;
        part.include({at, at});
      }
  return part;
}

/// By how much (m) the shape of what stands at `at` must be raised to touch the surface from above; less than 0: may be
/// lowered.
std::optional<double> Terrain::rise(const Tile& tile, const StandingShape& shape, const Pose& at) {
  const bool is_mesh = shape.shape.kind == ShapeKind::mesh;
  const ConvexBottom bottom(shape.shape, at * shape.pose,
                            is_mesh ? files_.meshes.of(shape.mesh) : std::span<const Vec3>());
  const Heightmap map = files_.heightmaps.of(tile.file, tile.size);
  const Aabb part = part_near(tile, bottom);
  const Vec3 half = 0.5 * tile.size;
  if (part.low.x() > half.x() || part.low.y() > half.y() || part.high.x() < -half.x() || part.high.y() < -half.y())
    return std::nullopt;
  const Heightmap::Cell first = map.cell_at(part.low.x(), part.low.y()),
                        last = map.cell_at(part.high.x(), part.high.y());
  RiseAbove above(bottom);
  for (std::uint32_t row = first.row; row <= last.row; ++row)
    for (std::uint32_t column = first.column; column <= last.column; ++column)
      for (const bool upper : {false, true}) {
        Heightmap::Triangle triangle = map.triangle({column, row}, upper);
        for (Vec3& corner : triangle) corner = tile.pose * corner;
        above.add(triangle);
      }
  return above.rise();
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
