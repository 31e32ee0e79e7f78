// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>

#include "collision_object.hpp"
#include "muro/algorithm.hpp"
#include "pair_collision.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::contact_geometry {

inline constexpr std::string_view mesh_options[] = {"convex", "exact"};
/// Parameters of collision algorithms that take meshes; the descriptions of their plugins name them.
inline constexpr Parameter mesh_parameters[] = {
    text("meshes", "convex", "whether a mesh collides as its convex hull or, exact, as it is").one_of(mesh_options),
};

/// Numbered geometries of all collision shapes of a scene. Equal geometries have one number.
class GeometryTable {
 public:
  static constexpr std::uint32_t none = 0xffffffff;
  /// Numbers of the geometries of one shape: the usual one, and its convex hull for pairs that need one.
  struct Numbers {
    std::uint32_t usual = none, convex = none;
  };

  /// Treatment of heightmaps.
  enum class Heightmaps {
    as_meshes,  ///< they are taken as triangles
    left_out,   ///< they have no geometry
  };

  /// Reads the meshes of all objects. `exact`: meshes collide as they are; flat ones, which have no hull, always do.
  /// `added` is called with each geometry, by rising number. [setup]
  void connect(Connector& c, bool exact, const std::function<void(const CollisionGeometry&)>& added = {},
               Heightmaps heightmaps = Heightmaps::as_meshes);
  /// `colliders` are those of the scene's index. [setup]
  void start(std::span<const Collider> colliders);

  std::size_t size() const { return geometries_.size(); }
  const CollisionGeometry& operator[](std::uint32_t number) const { return geometries_[number]; }
  /// Returns the numbers of a collider, by its number.
  const Numbers& of(std::uint32_t collider) const { return by_collider_[collider]; }
  bool is_exact_mesh(std::uint32_t number) const { return geometries_[number].exact_mesh != nullptr; }
  /// Chooses the geometries with which two colliders meet. Of two exact meshes, that of a robot is taken as its hull.
  /// With a plane, every mesh is taken as its hull. `none`: a flat mesh has no hull where one is needed; the two do not
  /// touch.
  void choose(const TransformedCollider& a, const TransformedCollider& b, std::uint32_t& number_a,
              std::uint32_t& number_b) const;

 private:
  void add_shape(Connector& c, ObjectId body, const Shape& shape, bool exact);
  void add_mesh(const std::string& path, const Shape& shape, bool exact, Numbers& numbers);
  std::uint32_t add_heightmap(const std::string& path, const Shape& shape);
  std::uint32_t add(const CollisionGeometry& geometry);
  const mesh::Hull* hull_if_any(const std::string& path, const Vec3& scale);
  const mesh::Hull* plate_if_any(const std::string& path, const Vec3& scale);

  mesh::Store meshes_;
  std::deque<mesh::Mesh> height_meshes_;
  std::deque<ExactMesh> exact_meshes_;
  std::deque<CollisionGeometry> geometries_;
  std::function<void(const CollisionGeometry&)> added_;
  std::vector<std::pair<Shape, Numbers>> known_;            ///< each shape once
  std::vector<std::pair<const Shape*, Numbers>> by_shape_;  ///< sorted
  std::vector<Numbers> by_collider_;
};

}  // namespace muro::contact_geometry
