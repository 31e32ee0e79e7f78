// SPDX-License-Identifier: MIT
#include "geometry_table.hpp"

#include <algorithm>

#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::contact_geometry {
namespace {

/// Whether two shapes have equal geometries, apart from their poses.
bool same_geometry(const Shape& a, const Shape& b) { return a.kind == b.kind && a.mesh == b.mesh && a.size == b.size; }

}  // namespace

void GeometryTable::connect(Connector& c, bool exact, const std::function<void(const CollisionGeometry&)>& added,
                            Heightmaps heightmaps) {
  added_ = added;
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes)) {
      const bool is_heightmap = s.kind == ShapeKind::heightmap;
      if (is_heightmap && c.robot_of(ObjectId{i}) != no_robot)
        throw Error(quote(c.object_name(ObjectId{i})) + " belongs to a robot and has a heightmap, which is of scenery");
      if (is_heightmap && heightmaps == Heightmaps::left_out)
        by_shape_.push_back({&s, {}});
      else
        add_shape(c, ObjectId{i}, s, exact);
    }
  std::sort(by_shape_.begin(), by_shape_.end(),
            [](const auto& a, const auto& b) { return std::less<>()(a.first, b.first); });
}

std::uint32_t GeometryTable::add(const CollisionGeometry& geometry) {
  geometries_.push_back(geometry);
  if (added_) added_(geometries_.back());
  return std::uint32_t(geometries_.size() - 1);
}

/// Returns the hull of a mesh; null if the mesh is flat.
const mesh::Hull* GeometryTable::hull_if_any(const std::string& path, const Vec3& scale) {
  try {
    return &meshes_.hull(path, scale);
  } catch (const Error&) {
    return nullptr;
  }
}

/// Returns the hull of a mesh, or its plate if it is flat; null if the mesh lies on a line.
const mesh::Hull* GeometryTable::plate_if_any(const std::string& path, const Vec3& scale) {
  try {
    return &meshes_.hull_or_plate(path, scale);
  } catch (const Error&) {
    return nullptr;
  }
}

void GeometryTable::add_mesh(const std::string& path, const Shape& shape, bool exact, Numbers& numbers) {
  const mesh::Mesh& surface = meshes_.mesh(path, shape.size);
  CollisionGeometry geometry{.shape = shape, .box = mesh::bounds_of(surface)};
  const mesh::Hull* const hull = hull_if_any(path, shape.size);
  if (exact || !hull) {
    geometry.exact_mesh = &exact_meshes_.emplace_back(surface);
    numbers.usual = add(geometry);
    geometry.exact_mesh = nullptr;
  }
  geometry.hull = hull ? hull : plate_if_any(path, shape.size);
  if (!geometry.hull) return;
  for (const Vec3& v : geometry.hull->vertices) geometry.box.include({v, v});
  numbers.convex = add(geometry);
}

std::uint32_t GeometryTable::add_heightmap(const std::string& path, const Shape& shape) {
  const mesh::Mesh& surface =
      height_meshes_.emplace_back(heightmap::mesh_of(heightmap::load(path).heightmap(shape.size)));
  CollisionGeometry geometry{.shape = shape, .box = mesh::bounds_of(surface)};
  geometry.shape.kind = ShapeKind::mesh;
  geometry.exact_mesh = &exact_meshes_.emplace_back(surface);
  return add(geometry);
}

void GeometryTable::add_shape(Connector& c, ObjectId body, const Shape& shape, bool exact) {
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const auto& k) { return same_geometry(k.first, shape); });
  if (known != known_.end()) {
    by_shape_.push_back({&shape, known->second});
    return;
  }
  Numbers numbers;
  if (shape.kind == ShapeKind::mesh) {
    try {
      add_mesh(std::string(c.text(shape.mesh)), shape, exact, numbers);
    } catch (const Error& error) {
      mesh::refuse_collision_mesh(c, body, error);
    }
  } else if (shape.kind == ShapeKind::heightmap) {
    try {
      numbers.usual = add_heightmap(std::string(c.text(shape.mesh)), shape);
    } catch (const Error& error) {
      mesh::refuse_collision_mesh(c, body, error);
    }
  } else {
    numbers.convex = add({.shape = shape, .box = {}});
  }
  if (numbers.usual == none) numbers.usual = numbers.convex;
  known_.push_back({shape, numbers});
  by_shape_.push_back({&shape, numbers});
}

void GeometryTable::start(std::span<const Collider> colliders) {
  by_collider_.clear();
  for (const Collider& c : colliders) {
    const auto numbers =
        std::lower_bound(by_shape_.begin(), by_shape_.end(), c.shape,
                         [](const auto& entry, const Shape* shape) { return std::less<>()(entry.first, shape); });
    by_collider_.push_back(numbers->second);
  }
}

void GeometryTable::choose(const TransformedCollider& a, const TransformedCollider& b, std::uint32_t& number_a,
                           std::uint32_t& number_b) const {
  const Numbers &of_a = of(a.number), &of_b = of(b.number);
  number_a = of_a.usual, number_b = of_b.usual;
  const auto is_plane = [](const TransformedCollider& c) { return c.shape.kind == ShapeKind::plane; };
  if (is_exact_mesh(number_a) && (is_exact_mesh(number_b) || is_plane(b))) {
    number_a = of_a.convex;
    if (b.collider->robot != no_robot) number_b = of_b.convex;
  } else if (is_exact_mesh(number_b) && is_plane(a)) {
    number_b = of_b.convex;
  }
}

}  // namespace muro::contact_geometry
