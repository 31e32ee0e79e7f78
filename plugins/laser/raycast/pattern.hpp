// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "bundle.hpp"
#include "muro/geometry.hpp"

namespace muro::raycast {

/// A grid of rays: `columns` azimuths, counter-clockwise about z from x, times `rows` elevations above the xy plane.
struct Grid {
  double min_angle = 0, max_angle = 0;  ///< rad
  std::uint32_t columns = 1;
  double min_elevation = 0, max_elevation = 0;  ///< rad, -pi/2 .. pi/2
  std::uint32_t rows = 1;

  /// Whether the azimuths go all the way round: the last then lies one increment before the first.
  bool full_circle() const;
  double first_angle() const;      ///< rad; a single column looks along the middle
  double angle_increment() const;  ///< rad; 0 for a single column
  double elevation(std::uint32_t row) const;
};

/// The rays of a scanner: their directions in the frame of the device, bundled.
class Pattern {
 public:
  /// Rays are numbered row by row from the lowest.
  explicit Pattern(const Grid& grid);
  /// Pairs of azimuth and elevation (rad), numbered as given; neighbours in the list should be neighbours in space.
  explicit Pattern(std::span<const double> azimuths_and_elevations);

  std::uint32_t size() const { return size_; }
  std::span<const Bundle> bundles() const { return bundles_; }
  std::span<const Sector> sectors() const { return sectors_; }
  /// Least and greatest z / sqrt(x^2 + y^2) of the rays; infinite for a ray along the z axis.
  double min_slope() const { return min_slope_; }
  double max_slope() const { return max_slope_; }

 private:
  void add(const Vec3& direction, std::uint32_t ray, Bundle& bundle);
  void close(Bundle& bundle);
  void make_sectors();

  std::uint32_t size_ = 0;
  std::vector<Bundle> bundles_;
  std::vector<Sector> sectors_;
  double min_slope_ = 0, max_slope_ = 0;
};

/// The unit vector at an azimuth and an elevation (rad).
Vec3 direction_of(double azimuth, double elevation);

}  // namespace muro::raycast
