// SPDX-License-Identifier: MIT
#pragma once

namespace muro::native {

/// A plane that is above all points of the surface near a tile, or touches them. In the frame of the heightmap.
struct TerrainTile {
  float height;            ///< m, of the plane over the middle of the tile
  float slope_x, slope_y;  ///< of the plane
  float spread;            ///< most by which slopes of triangles near the tile differ from these
};

/// Tiles of one size.
struct TerrainLevel {
  const TerrainTile* tiles = nullptr;
  int columns = 0, rows = 0;
  double length_x = 0, length_y = 0;  ///< m, of a tile
  double per_x = 0, per_y = 0;        ///< 1/m, the inverse of these
  double reach = 0;                   ///< m, what is at most this far from a tile counts as near it
};

/// A heightmap of the scenery as plain numbers; see muro/toolkit/heightmap.hpp.
struct TerrainGrid {
  static constexpr int max_levels = 16;

  const float* values = nullptr;
  int columns = 0, rows = 0;                     ///< of nodes
  double half_x = 0, half_y = 0;                 ///< m
  double spacing_x = 0, spacing_y = 0;           ///< m
  double per_spacing_x = 0, per_spacing_y = 0;   ///< 1/m, the inverse of these
  double scale = 1;                              ///< m, the height of a value of 1
  double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< of its frame in the world, column by column
  double origin[3] = {};                         ///< m, world
  bool is_turned = false;                        ///< its axes are not those of the world
  TerrainLevel levels[max_levels];               ///< by rising reach
  int level_count = 0;

  /// Returns the level for shapes that reach up to `radius` (m) from their centres; null: there is none.
  const TerrainLevel* level_for(double radius) const {
    for (int k = 0; k < level_count; ++k)
      if (levels[k].reach >= radius) return &levels[k];
    return nullptr;
  }
};

}  // namespace muro::native
