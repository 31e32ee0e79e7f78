// SPDX-License-Identifier: MIT
#pragma once

#include "terrain_grid.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// A box in the frame of a heightmap.
struct BoxOverTerrain {
  double centre[3];   ///< m
  double axes[3][3];  ///< unit
  double half[3];     ///< m
};

/// Returns a lower bound (m) of the distance between the surface below a box and the side of the box that faces down.
/// Where the surface is at most `beside` (m) along x and y beside what the box covers, the plane of that side counts.
/// Returns 0 where they may touch, and where more than a few cells lie below the box and their tiles do not decide it.
/// Checks tile by tile, then cell by cell.
[[gnu::noinline]] inline double clearance_below(const TerrainGrid& grid, const BoxOverTerrain& box, double beside) {
  constexpr int max_cells = 64, max_tiles = 25;
  int down = 0;
  double reach[2] = {beside, beside};
  for (int k = 0; k < 3; ++k) {
    if (__builtin_fabs(box.axes[k][2]) > __builtin_fabs(box.axes[down][2])) down = k;
    for (int i = 0; i < 2; ++i) reach[i] += box.half[k] * __builtin_fabs(box.axes[k][i]);
  }
  const double* const axis = box.axes[down];
  if (!(__builtin_fabs(axis[2]) > 0.5)) return 0;
  // the side: z = height + slope_x x + slope_y y, relative to the centre
  const double slope_x = -axis[0] / axis[2], slope_y = -axis[1] / axis[2],
               height = box.centre[2] - box.half[down] / __builtin_fabs(axis[2]);
  const auto clamped = [](double at, int nodes) { return at > 0 ? (at < nodes - 2 ? int(at) : nodes - 2) : 0; };
  const double upright = __builtin_fabs(axis[2]);
  const double low_x = box.centre[0] - reach[0], high_x = box.centre[0] + reach[0];
  const double low_y = box.centre[1] - reach[1], high_y = box.centre[1] + reach[1];
  /// Returns the gap that tiles of one size show; 0: none.
  const auto clearance_of_tiles = [&](const TerrainLevel& level) {
    const int first_x = clamped((low_x + grid.half_x) * level.per_x, level.columns + 1),
              last_x = clamped((high_x + grid.half_x) * level.per_x, level.columns + 1),
              first_y = clamped((low_y + grid.half_y) * level.per_y, level.rows + 1),
              last_y = clamped((high_y + grid.half_y) * level.per_y, level.rows + 1);
    if ((last_x - first_x + 1) * (last_y - first_y + 1) > max_tiles) return 0.0;
    double least = __builtin_inf();
    for (int row = first_y; row <= last_y; ++row)
      for (int column = first_x; column <= last_x; ++column) {
        const TerrainTile& tile = level.tiles[long(row) * level.columns + column];
        // height of the side at the middle of the tile, and the most that the plane of the tile rises towards it
        const double x = (column + 0.5) * level.length_x - grid.half_x, y = (row + 0.5) * level.length_y - grid.half_y;
        const double side = height + slope_x * (x - box.centre[0]) + slope_y * (y - box.centre[1]);
        const double rise = 0.5 * __builtin_fabs(double(tile.slope_x) - slope_x) * level.length_x +
                            0.5 * __builtin_fabs(double(tile.slope_y) - slope_y) * level.length_y;
        const double gap = side - double(tile.height) - rise;
        if (!(gap > 0)) return 0.0;
        least = gap < least ? gap : least;
      }
    return least;
  };
  for (int k = grid.level_count - 1; k >= 0; --k) {
    const TerrainLevel& level = grid.levels[k];
    if (level.length_x * 4 < high_x - low_x || level.length_y * 4 < high_y - low_y) break;
    if (!(level.length_x < high_x - low_x && level.length_y < high_y - low_y)) continue;
    if (const double gap = clearance_of_tiles(level); gap > 0) return gap * upright;
  }
  const int first_column = clamped((low_x + grid.half_x) * grid.per_spacing_x, grid.columns),
            last_column = clamped((high_x + grid.half_x) * grid.per_spacing_x, grid.columns),
            first_row = clamped((low_y + grid.half_y) * grid.per_spacing_y, grid.rows),
            last_row = clamped((high_y + grid.half_y) * grid.per_spacing_y, grid.rows);
  if ((last_column - first_column + 1) * (last_row - first_row + 1) > max_cells) return 0;
  double least = __builtin_inf();
  for (int row = first_row; row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column) {
      const float* const lower = grid.values + long(row) * grid.columns + column;
      const float* const upper = lower + grid.columns;
      const double x = column * grid.spacing_x - grid.half_x, y = row * grid.spacing_y - grid.half_y;
      const double left = low_x > x ? low_x - x : 0, right = high_x < x + grid.spacing_x ? high_x - x : grid.spacing_x;
      const double front = low_y > y ? low_y - y : 0, back = high_y < y + grid.spacing_y ? high_y - y : grid.spacing_y;
      // both triangles, each as a height at a corner and slopes relative to the side
      const double side = height + slope_x * (x - box.centre[0]) + slope_y * (y - box.centre[1]);
      const double slopes[2][2] = {{(double(lower[1]) - double(lower[0])) * grid.scale * grid.per_spacing_x - slope_x,
                                    (double(upper[0]) - double(lower[0])) * grid.scale * grid.per_spacing_y - slope_y},
                                   {(double(upper[1]) - double(upper[0])) * grid.scale * grid.per_spacing_x - slope_x,
                                    (double(upper[1]) - double(lower[1])) * grid.scale * grid.per_spacing_y - slope_y}};
      for (int t = 0; t < 2; ++t) {
        const double(&s)[2] = slopes[t];
        const double corner = t == 0 ? grid.scale * double(lower[0])
                                     : grid.scale * double(upper[1]) - (s[0] + slope_x) * grid.spacing_x -
                                           (s[1] + slope_y) * grid.spacing_y;
        const double highest =
            corner - side + (s[0] > 0 ? s[0] * right : s[0] * left) + (s[1] > 0 ? s[1] * back : s[1] * front);
        if (!(highest < 0)) return 0;
        least = -highest < least ? -highest : least;
      }
    }
  return least * upright;
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
