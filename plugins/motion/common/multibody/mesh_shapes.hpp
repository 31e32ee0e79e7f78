// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/contact_geometry/terrain/scene_heightmaps.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::multibody {

/// The collision meshes of a scene. Each is read once and becomes a `MeshShape` of the engine. Also holds the
/// heightmaps and the hulls of robots that can touch them.
template <class MeshShape>
class MeshShapes {
 public:
  /// Reads the meshes of all collision shapes. `exact`: scenery collides with its exact meshes; everything else
  /// collides with convex hulls. `of_hull`, `of_mesh`: make a shape from a mesh::Hull or mesh::Mesh. A mesh that cannot
  /// be read, or has no hull, is refused: see mesh::refuse_collision_mesh. [setup]
  template <class OfHull, class OfMesh>
  void load(Connector& c, bool exact, OfHull of_hull, OfMesh of_mesh) {
    exact_ = exact;
    heightmaps_.load(c);
    mesh::Store store;
    for (std::uint32_t i = 0; i < c.object_count(); ++i) {
      const ObjectId object{i};
      const bool hull = !exact || c.robot_of(object) != no_robot;
      for (const Shape& s : c.constant_array(object, keys::collision_shapes)) {
        if (s.kind != ShapeKind::mesh) continue;
        const Key key = key_of(s, hull);
        const std::string path(c.text(s.mesh));
        try {
          if (!shapes_.contains(key))
            shapes_.emplace(key, hull ? of_hull(store.hull_or_plate(path, s.size)) : of_mesh(store.mesh(path, s.size)));
          if (!heightmaps_.empty() && c.robot_of(object) != no_robot)
            hulls_.try_emplace(key, store.hull_or_plate(path, s.size));
        } catch (const Error& error) {
          mesh::refuse_collision_mesh(c, object, error);
        }
      }
    }
  }

  /// Returns the engine's shape for a shape of kind mesh. `moves`: whether it belongs to a robot.
  const MeshShape& of(const Shape& shape, bool moves) const { return shapes_.at(key_of(shape, moves || !exact_)); }
  /// Returns the heightmap of a scenery shape of kind heightmap. Valid as long as this object lives.
  Heightmap heightmap(const Shape& shape) const { return heightmaps_.of(shape); }
  /// Returns a shape of a robot for terrain_contact::find_contacts, with its pose not set. A mesh has no hull in a
  /// scene without heightmaps.
  terrain_contact::ConvexShape convex_shape(const Shape& shape) const {
    const auto hull = hulls_.find(key_of(shape, true));
    return {
        shape.kind, shape.size, shape.kind == ShapeKind::mesh && hull != hulls_.end() ? &hull->second : nullptr, {}};
  }

 private:
  /// File, scale, and whether the shape is the hull.
  using Key = std::tuple<TextId, double, double, double, bool>;
  static Key key_of(const Shape& s, bool hull) { return {s.mesh, s.size.x(), s.size.y(), s.size.z(), hull}; }

  bool exact_ = false;
  std::map<Key, MeshShape> shapes_;
  terrain_contact::SceneHeightmaps heightmaps_;
  std::map<Key, mesh::Hull> hulls_;  ///< hulls of robots, when there are heightmaps
};

}  // namespace muro::multibody
