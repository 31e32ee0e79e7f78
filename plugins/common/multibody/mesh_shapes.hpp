// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::multibody {

/// The collision meshes of a scene, each read once, as the shapes `MeshShape` that an engine makes of them.
template <class MeshShape>
class MeshShapes {
 public:
  /// Reads the meshes of all collision shapes. `exact`: scenery collides as its meshes are; all else collides as their
  /// convex hulls. `of_hull`, `of_mesh`: make a shape from a mesh::Hull or mesh::Mesh. A mesh that cannot be
  /// read, or has no hull, is refused: see mesh::refuse_collision_mesh. [setup]
  template <class OfHull, class OfMesh>
  void load(Connector& c, bool exact, OfHull of_hull, OfMesh of_mesh) {
    exact_ = exact;
    mesh::Store store;
    for (std::uint32_t i = 0; i < c.object_count(); ++i) {
      const ObjectId object{i};
      const bool hull = !exact || c.robot_of(object) >= 0;
      for (const Shape& s : c.constant_array(object, keys::collision_shapes)) {
        if (s.kind != ShapeKind::mesh || shapes_.contains(key_of(s, hull))) continue;
        const std::string path(c.text(s.mesh));
        try {
          shapes_.emplace(key_of(s, hull),
                          hull ? of_hull(store.hull(path, s.size)) : of_mesh(store.mesh(path, s.size)));
        } catch (const Error& error) {
          mesh::refuse_collision_mesh(c, object, error);
        }
      }
    }
  }

  /// Of a shape of kind mesh. `moves`: it belongs to a robot.
  const MeshShape& of(const Shape& shape, bool moves) const { return shapes_.at(key_of(shape, moves || !exact_)); }

 private:
  /// Which file, at which scale, and whether as its hull.
  using Key = std::tuple<TextId, double, double, double, bool>;
  static Key key_of(const Shape& s, bool hull) { return {s.mesh, s.size.x(), s.size.y(), s.size.z(), hull}; }

  bool exact_ = false;
  std::map<Key, MeshShape> shapes_;
};

}  // namespace muro::multibody
