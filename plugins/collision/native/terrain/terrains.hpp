// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "muro/algorithm.hpp"
#include "pairs/conversions.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "terrain/terrain.hpp"

namespace muro::native {

/// The heightmaps of the scenery.
class Terrains {
 public:
  /// Reads their files. [setup]
  void connect(Connector& c);
  /// `radius` (m): the farthest that a shape of a robot reaches from its centre. [setup]
  void start(std::span<const Collider> colliders, double radius);

  /// By the number of a collider; null: it is none.
  const Terrain* of(std::uint32_t collider) const {
    return collider < by_collider_.size() ? by_collider_[collider] : nullptr;
  }
  /// The box around a heightmap of the scenery and the ground below it; null: it is none.
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
