// SPDX-License-Identifier: MIT
#pragma once

#include "box_table_builder.hpp"
#include "height_tree.hpp"

namespace muro::raycast {

/// What rays can hit, in the form that the kernels read: built once from a scene index, updated once an instant.
/// Meshes are left out.
class SceneTable {
 public:
  /// Copies shapes and scenery, and does what `update` does. `heightmaps` stay where they are.
  void build(const SceneIndex& scene, const HeightTrees& heightmaps = {});
  /// Copies where robots are. Does not allocate. [step]
  void update(const SceneIndex& scene);

  SceneView view() const;
  /// Heightmaps relative to rays that start at a point of the world (m). Fills as many as there are. [step]
  void place_heightmaps(const Vec3& start, PlacedHeightmap* placed) const;
  std::size_t heightmap_count() const { return heightmaps_.size(); }
  /// The object that has the collider; none for -1.
  ObjectId body(std::int64_t collider) const { return collider < 0 ? no_object : bodies_[std::size_t(collider)]; }
  /// Blocks of sixteen boxes.
  std::size_t block_count() const { return scenery_.block_count() + moving_.block_count(); }
  std::size_t robot_count() const { return robots_.size(); }
  std::size_t primitive_count() const { return primitives_.size(); }
  std::size_t plane_count() const { return planes_.size(); }

 private:
  BoxTableBuilder scenery_, moving_;
  std::vector<Primitive> primitives_;
  std::vector<PrimitiveRange> robots_;  ///< by number
  std::vector<Plane> planes_;
  struct SceneryHeightmap {
    const HeightTree* tree;
    HeightField field;
    Pose pose;
    std::uint32_t id;
  };
  std::vector<SceneryHeightmap> heightmaps_;
  std::vector<ObjectId> bodies_;  ///< by collider
};

}  // namespace muro::raycast
