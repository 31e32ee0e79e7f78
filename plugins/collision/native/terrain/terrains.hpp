// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "muro/algorithm.hpp"
#include "pairs/conversions.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "terrain/terrain.hpp"

namespace muro::native {

/// Heightmaps of the scenery.
class Terrains {
 public:
  /// Reads their files. [setup]
  void connect(Connector& c);
  /// `radius` (m): the farthest that a shape of a robot reaches from its centre. [setup]
  void start(std::span<const Collider> colliders, double radius);

  /// Returns the terrain of a collider by its number; null: it is not a heightmap.
  const Terrain* of(std::uint32_t collider) const {
    return collider < by_collider_.size() ? by_collider_[collider] : nullptr;
  }
  /// Returns the box around a heightmap of the scenery and the ground below it; null: it is not a heightmap.
  const Aabb* box_of(const Shape& shape) const;

 private:
  struct File {
    const Shape* shape;
    Heightmap map;
    Aabb box;  ///< m, in the frame of the shape
  };

  heightmap::Store store_;
  std::vector<File> files_;
  std::deque<Terrain> terrains_;
  std::vector<const Terrain*> by_collider_;
};

}  // namespace muro::native
