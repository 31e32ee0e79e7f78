// SPDX-License-Identifier: MIT
#pragma once

#include "box_table_builder.hpp"
#include "height_tree.hpp"

namespace muro::raycast {

/// The shapes that rays can hit, in the form that the kernels read. It is built once from a scene index and updated
/// once an instant. Meshes are left out.
class SceneTable {
 public:
  /// Copies shapes and scenery, and calls `update`. `heightmaps` must not move or change afterwards.
  void build(const SceneIndex& scene, const HeightTrees& heightmaps = {});
  /// Copies the poses of robots. Does not allocate. [step]
  void update(const SceneIndex& scene);

  SceneView view() const;
  /// Places all heightmaps relative to rays from `start` (m, world). `placed`: heightmap_count() elements. [step]
  void place_heightmaps(const Vec3& start, PlacedHeightmap* placed) const;
  std::size_t heightmap_count() const { return heightmaps_.size(); }
  /// Returns the object of a collider; no_object for -1.
  ObjectId body(std::int64_t collider) const { return collider < 0 ? no_object : bodies_[std::size_t(collider)]; }
  /// Returns the number of blocks of sixteen boxes.
  std::size_t block_count() const { return scenery_.block_count() + moving_.block_count(); }
  std::size_t robot_count() const { return robots_.size(); }
  std::size_t primitive_count() const { return primitives_.size(); }
  std::size_t plane_count() const { return planes_.size(); }

 private:
  BoxTableBuilder scenery_, moving_;
  std::vector<Primitive> primitives_;
  std::vector<PrimitiveRange> robots_;  ///< by number of the robot
  std::vector<Plane> planes_;
  struct SceneryHeightmap {
    const HeightTree* tree;
    HeightField field;
    Pose pose;
    std::uint32_t id;
  };
  std::vector<SceneryHeightmap> heightmaps_;
  std::vector<ObjectId> bodies_;  ///< by number of the collider
};

}  // namespace muro::raycast
