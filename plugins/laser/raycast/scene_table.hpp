// SPDX-License-Identifier: MIT
#pragma once

#include "box_columns.hpp"

namespace muro::raycast {

/// What rays can meet, in the form the kernels read: made once of an index, brought up to date once an instant. Meshes
/// are left out.
class SceneTable {
 public:
  /// Takes over shapes and scenery, and does what `update` does.
  void build(const SceneIndex& scene);
  /// Takes over where robots are. Allocates nothing. [step]
  void update(const SceneIndex& scene);

  Sight sight() const;
  /// The object that has the collider; none for -1.
  ObjectId body(std::int64_t collider) const { return collider < 0 ? no_object : bodies_[std::size_t(collider)]; }
  /// Blocks of sixteen boxes.
  std::size_t block_count() const { return scenery_.block_count() + moving_.block_count(); }
  std::size_t robot_count() const { return robots_.size(); }
  std::size_t solid_count() const { return solids_.size(); }
  std::size_t plane_count() const { return planes_.size(); }

 private:
  BoxColumns scenery_, moving_;
  std::vector<Solid> solids_;
  std::vector<SolidRange> robots_;  ///< by number
  std::vector<Plane> planes_;
  std::vector<ObjectId> bodies_;  ///< by collider
};

}  // namespace muro::raycast
