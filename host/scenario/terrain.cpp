// SPDX-License-Identifier: MIT
#include "host/scenario/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/extent_along.hpp"
#include "muro/base/bounds.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Cosines of the largest angle between the vertical and the normal of a surface, and of a floor.
constexpr double least_upward = 0.1, least_upward_of_floor = M_SQRT1_2;
constexpr double least_flatness = 10;  ///< of a floor: width divided by thickness

/// Returns the axis along which a box is thinnest, if it is a plate.
std::optional<int> thin_axis(const Vec3& size) {
  int axis = 0;
  const double thickness = size.minCoeff(&axis);
  const double width = std::min(size[(axis + 1) % 3], size[(axis + 2) % 3]);
  return width >= least_flatness * thickness ? std::optional(axis) : std::nullopt;
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

bool Terrain::carries(const Shape& shape) {
  return shape.kind == ShapeKind::plane || shape.kind == ShapeKind::heightmap ||
         (shape.kind == ShapeKind::box && thin_axis(shape.size));
}

void Terrain::add(const Shape& shape, const std::string& file, const Pose& pose) {
  if (shape.kind == ShapeKind::box) {
    const std::optional<int> axis = thin_axis(shape.size);
    if (!axis || std::abs((pose.orientation * Vec3::Unit(*axis)).z()) < least_upward_of_floor) return;
    const Aabb box = bounds_of(shape, pose);
    const Floor floor{pose, 0.5 * shape.size, box.low.z(), box.high.z()};
    const auto by_height = [](const Floor& a, const Floor& b) { return a.high < b.high; };
    floors_.insert(std::upper_bound(floors_.begin(), floors_.end(), floor, by_height), floor);
    return;
  }
  if ((pose.orientation * Vec3::UnitZ()).z() < least_upward) return;
  if (shape.kind == ShapeKind::plane) planes_.push_back(pose);
  if (shape.kind == ShapeKind::heightmap) tiles_.push_back({file, shape.size, pose});
}

void Terrain::add_scenery(const World& world) {
  for (std::uint32_t i = 1; i < world.object_count(); ++i) {
    const ObjectId object{i};
    if (world.robot_of(object) != no_robot) continue;
    const Pose* const pose = world.find_constant(object, keys::pose);
    if (!pose) continue;
    for (const Shape& s : world.constants(object, keys::collision_shapes))
      add(s, s.kind == ShapeKind::heightmap ? std::string(world.text(s.mesh)) : "", *pose * s.origin);
  }
}

/// Returns the lowest and the highest height (m) of a map, in its frame.
std::array<double, 2> Terrain::heights_of(const Tile& tile) {
  const auto known = heights_.find(tile.file);
  if (known != heights_.end()) return {tile.size.z() * known->second[0], tile.size.z() * known->second[1]};
  const Heightmap map = files_.heightmaps.of(tile.file, tile.size);
  const auto [low, high] = std::minmax_element(map.values.begin(), map.values.end());
  heights_[tile.file] = {double(*low), double(*high)};
  return heights_of(tile);
}

/// Returns the part of a tile, in its frame, that is above or below a box of the world. In the frame of a tilted map
/// the vertical is oblique.
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

/// Adds the triangles that are above or below the shape.
void Terrain::add_triangles(const Tile& tile, RiseAbove& above) {
  const Heightmap map = files_.heightmaps.of(tile.file, tile.size);
  const Aabb part = part_near(tile, above.bottom());
  const Vec3 half = 0.5 * tile.size;
  if (part.low.x() > half.x() || part.low.y() > half.y() || part.high.x() < -half.x() || part.high.y() < -half.y())
    return;
  const Heightmap::Cell first = map.cell_at(part.low.x(), part.low.y()),
                        last = map.cell_at(part.high.x(), part.high.y());
  for (std::uint32_t row = first.row; row <= last.row; ++row)
    for (std::uint32_t column = first.column; column <= last.column; ++column)
      for (const bool upper : {false, true}) {
        Heightmap::Triangle triangle = map.triangle({column, row}, upper);
        for (Vec3& corner : triangle) corner = tile.pose * corner;
        above.add(triangle);
      }
}

/// Returns the height (m) by which a body at `at` must be raised to touch a surface from above; less than 0 when it may
/// be lowered. Returns nothing when the surface is not below or above it. Calls add_triangles(above) for each shape.
template <class AddTriangles>
std::optional<double> Terrain::rise(std::span<const StandingShape> shapes, const Pose& at, AddTriangles add_triangles) {
  std::optional<double> most;
  for (const StandingShape& s : shapes) {
    const bool is_mesh = s.shape.kind == ShapeKind::mesh;
    const ConvexBottom bottom(s.shape, at * s.pose, is_mesh ? files_.meshes.of(s.mesh) : std::span<const Vec3>());
    RiseAbove above(bottom, most);
    add_triangles(above);
    most = above.rise();
  }
  return most;
}

/// Returns how far (m) shapes with this orientation extend from their origin along `direction`.
double Terrain::extent_along(std::span<const StandingShape> shapes, const Quat& orientation, const Vec3& direction) {
  const Vec3 in_body = orientation.conjugate() * direction;
  std::optional<double> most;
  for (const StandingShape& s : shapes) {
    const bool is_mesh = s.shape.kind == ShapeKind::mesh;
    const double extent =
        muro::extent_along(s.shape, is_mesh ? files_.meshes.of(s.mesh) : std::span<const Vec3>(), s.pose, in_body);
    most = most ? std::max(*most, extent) : extent;
  }
  return most.value_or(0);
}

std::optional<double> Terrain::height_on_terrain(std::span<const StandingShape> shapes, const Pose& at) {
  Pose pose = at;
  pose.position.z() = 0;
  std::optional<double> most;
  for (const Tile& tile : tiles_) {
    const auto height = rise(shapes, pose, [&](RiseAbove& above) { add_triangles(tile, above); });
    if (height) most = most ? std::max(*most, *height) : *height;
  }
  for (const Pose& plane : planes_) {
    const Vec3 normal = plane.orientation * Vec3::UnitZ();
    const double below = extent_along(shapes, at.orientation, -normal);
    const double height = (below - normal.dot(pose.position - plane.position)) / normal.z();
    most = most ? std::max(*most, height) : height;
  }
  return most;
}

std::optional<double> Terrain::height_on_floor(const Floor& floor, std::span<const StandingShape> shapes,
                                               const Pose& at) {
  Pose pose = at;
  pose.position.z() = 0;
  return rise(shapes, pose, [&](RiseAbove& above) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        const Vec3 out = side * floor.half[axis] * Vec3::Unit(axis);
        const Vec3 u = floor.half[(axis + 1) % 3] * Vec3::Unit((axis + 1) % 3),
                   v = side * floor.half[(axis + 2) % 3] * Vec3::Unit((axis + 2) % 3);
        const Pose& p = floor.pose;
        above.add({p * (out - u - v), p * (out + u - v), p * (out + u + v)});
        above.add({p * (out - u - v), p * (out + u + v), p * (out - u + v)});
      }
  });
}

double Terrain::height(std::span<const StandingShape> all, const Pose& at) {
  const StandingShape origin{Shape::sphere(0), "", {}};
  const std::span<const StandingShape> shapes = all.empty() ? std::span(&origin, 1) : all;
  const double on_zero = extent_along(shapes, at.orientation, -Vec3::UnitZ());
  std::optional<double> height = height_on_terrain(shapes, at);
  if (floors_.empty()) return height.value_or(on_zero);
  const double above = extent_along(shapes, at.orientation, Vec3::UnitZ());
  for (const Floor& floor : floors_) {
    if (!height && floor.low > 0) height = on_zero;
    if (height && floor.low >= *height + above) continue;  // the body is below this floor
    const std::optional<double> on_floor = height_on_floor(floor, shapes, at);
    if (on_floor) height = height ? std::max(*height, *on_floor) : *on_floor;
  }
  return height.value_or(on_zero);
}

}  // namespace muro::host
