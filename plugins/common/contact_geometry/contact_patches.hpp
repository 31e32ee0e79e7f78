// SPDX-License-Identifier: MIT
// Contact patches: adjacent contacts of two shapes with one normal, which are the ends of a line or the corners of a
// face. Cells of their points: see pressure_cells.hpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "muro/geometry.hpp"
#include "pressure_cells.hpp"

namespace muro::contact_geometry {

/// Calls `sink(begin, end)` for each patch, which is contacts `begin` to `end` - 1. Each of `count` contacts is in one
/// patch. `belongs(first, i)`: whether contact i may be in the patch that begins with contact `first`.
template <class Belongs, class Sink>
void each_patch(std::size_t count, const Belongs& belongs, const Sink& sink) {
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin + 1; end < count && belongs(begin, end);) ++end;
    sink(begin, end);
  }
}

/// Calls find_shifts() for points in memory: `point(i)` are three numbers (m). Shifts go to `sink(i, Vec3)`.
template <class Point, class Sink>
void find_cells(std::size_t count, bool is_of_disc, const Point& point, const Sink& sink) {
  find_shifts(
      int(count), is_of_disc,
      [&](int i) {
        const double* p = point(std::size_t(i));
        return lane::V3<double>{p[0], p[1], p[2]};
      },
      [&](int i, const lane::V3<double>& shift) { sink(std::size_t(i), Vec3(shift.x, shift.y, shift.z)); });
}

/// Returns the speed (m/s) of the ends of a cell about its middle, as far as it counts (see least_spin). `spin`
/// (rad/s): about the normal. `cell` (m): from a point of the patch to the middle of the cell.
inline double speed_of_ends(double spin, const Vec3& cell) {
  return std::max(std::abs(spin) * cell.norm() - least_spin, 0.0);
}

}  // namespace muro::contact_geometry
