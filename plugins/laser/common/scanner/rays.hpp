// SPDX-License-Identifier: MIT
// The directions of the rays of a scanner.
#pragma once

#include <span>
#include <vector>

#include "muro/geometry.hpp"

namespace muro::scanner {

/// A grid of rays: `columns` azimuths, counter-clockwise about z from x, times `rows` elevations above the xy plane.
struct Grid {
  double min_angle = 0, max_angle = 0;  ///< rad
  std::uint32_t columns = 1;
  double min_elevation = 0, max_elevation = 0;  ///< rad, -pi/2 .. pi/2
  std::uint32_t rows = 1;

  /// Whether the azimuths cover a full circle. Then the last azimuth is one increment before the first.
  bool full_circle() const;
  double first_angle() const;      ///< rad; the middle for a single column
  double angle_increment() const;  ///< rad; 0 for a single column
  double azimuth(std::uint32_t column) const;
  double elevation(std::uint32_t row) const;
};

/// Returns the unit vector at an azimuth and an elevation (rad).
Vec3 direction_of(double azimuth, double elevation);

/// Rays that start at one point at one instant.
struct RaySet {
  std::vector<Vec3> directions;  ///< unit vectors in the frame of the device, row by row; neighbours are adjacent
  std::uint32_t columns = 0, rows = 1;
  double spacing = 0;  ///< rad, between neighbours; 0: unknown

  std::uint32_t size() const { return std::uint32_t(directions.size()); }

  /// Returns the rays of a grid, beginning with the lowest row.
  static RaySet of(const Grid& grid);
  /// Returns one row of rays. `azimuths_and_elevations`: pairs, rad.
  static RaySet of(std::span<const double> azimuths_and_elevations);
};

}  // namespace muro::scanner
