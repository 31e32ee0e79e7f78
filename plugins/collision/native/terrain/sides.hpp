// SPDX-License-Identifier: MIT
#pragma once

#include "terrain/solid.hpp"
#include "terrain/terrain.hpp"

namespace muro::native {

/// A triangle of a heightmap, or what is beyond the rim, as a solid sees it.
struct Side {
  Vec3 normal;  ///< unit, of the ground
  Vec3 lowest;  ///< a point of the solid's core that is lowest along the normal
};

/// The triangles of a heightmap about a solid, each computed once where few are asked for.
class Sides {
 public:
  Sides(const Solid& solid, const Terrain& terrain) : solid_(solid), terrain_(terrain) {}

  const Side& of(Heightmap::Cell c, bool upper) {
    const std::uint64_t number = 2 * (std::uint64_t(c.row) * terrain_.map().columns + c.column) + (upper ? 1 : 0);
    // cells side by side, in rows of eight
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
  std::uint64_t numbers_[places] = {};  ///< one more than the triangle's; 0: none
  Side sides_[places];
};

}  // namespace muro::native
