// SPDX-License-Identifier: MIT
#pragma once

#include "terrain/solid.hpp"
#include "terrain/terrain.hpp"

namespace muro::native {

/// A triangle of a heightmap, or the outside of its rim, relative to a solid.
struct Side {
  Vec3 normal;  ///< unit, of the ground
  Vec3 lowest;  ///< point of the solid's core that is lowest along the normal
};

/// Triangles of a heightmap about a solid. Each is computed only once if few are needed.
class Sides {
 public:
  Sides(const Solid& solid, const Terrain& terrain) : solid_(solid), terrain_(terrain) {}

  const Side& of(Heightmap::Cell c, bool upper) {
    const std::uint64_t number = 2 * (std::uint64_t(c.row) * terrain_.map().columns + c.column) + (upper ? 1 : 0);
    // place of the cell in a block of eight by eight cells
    const std::size_t place = 2 * (8 * (c.row % 8) + c.column % 8) + (upper ? 1 : 0);
    if (numbers_[place] != number + 1) {
      sides_[place] = along(terrain_.normal(c, upper));
      numbers_[place] = number + 1;
    }
    return sides_[place];
  }
  Side along(const Vec3& normal) const { return {normal, solid_.core.support(-normal)}; }

 private:
  static constexpr std::size_t places = 128;
  const Solid& solid_;
  const Terrain& terrain_;
  std::uint64_t numbers_[places] = {};  ///< number of the triangle plus one; 0: none
  Side sides_[places];
};

}  // namespace muro::native
