// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "fan.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/contact_geometry/box_tree.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::line_of_sight {

/// Finds the obstacles between two points, by the scene's index: see README.md.
class LineOfSight {
 public:
  /// Asks for scene.index and reads the meshes and heightmaps of the scene. [setup]
  void connect(Connector& c);
  /// Must be called by one thread in each step, before the first search.
  void begin_step() {
    if (solids_.size() != scene_->colliders.size()) find_solids();
  }
  /// How many obstacles the line from `a` to `b` (m, world) passes through, at most `most`: each shape of the scenery
  /// counts, and each robot as one. The line runs 1 mm above its ends: what stands on a floor is in its way, the floor
  /// is not. Robots `own` and `other` (or no_robot) do not count. From `b` to `a` there are exactly as many.
  /// [step, any thread]
  std::uint32_t obstacles(const Vec3& a, const Vec3& b, RobotId own, RobotId other, std::uint32_t most = 1) const;
  bool is_clear(const Vec3& a, const Vec3& b, RobotId own, RobotId other) const {
    return obstacles(a, b, own, other) == 0;
  }
  /// Lets `fan` know what may be in the way of about so many `lines` from `centre` (m, world) that are no longer than
  /// `reach` (m), robot `own` excepted. Many lines from one point take less time so. [step, any thread]
  void look_around(const Vec3& centre, RobotId own, double reach, std::size_t lines, Fan& fan) const;
  /// The number of obstacles from the centre of a fan, with which this object has looked around in this step, to `to`.
  std::uint32_t obstacles(const Fan& fan, const Vec3& to, RobotId other, std::uint32_t most = 1) const;

 private:
  struct TriangleMesh {
    const mesh::Mesh* mesh;
    contact_geometry::BoxTree tree;  ///< of its triangles
  };
  struct Ground {
    Heightmap map;
    double highest;  ///< m
  };
  /// Content of a collider that is a mesh or heightmap.
  struct Solid {
    const TriangleMesh* mesh = nullptr;
    const Ground* ground = nullptr;
  };
  Solid load(Connector& c, const Shape& shape);
  void find_solids();
  bool is_cut(const Segment& segment, std::uint32_t collider) const;
  bool is_cut_by_robot(const Segment& segment, std::uint32_t robot) const;
  /// Returns the number of the first robot in a fan; numbers of colliders come before it.
  std::uint32_t first_robot() const { return std::uint32_t(scene_->colliders.size()); }

  In<SceneIndex> scene_;
  mesh::Store meshes_;
  heightmap::Store heightmaps_;
  std::vector<std::unique_ptr<TriangleMesh>> triangle_meshes_;
  std::map<const mesh::Mesh*, const TriangleMesh*> known_meshes_;
  std::vector<std::unique_ptr<Ground>> grounds_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Solid> solid_of_shape_;  ///< by object and number of the shape
  std::vector<Solid> solids_;                                                ///< by collider
};

}  // namespace muro::line_of_sight
