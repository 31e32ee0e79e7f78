// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "bundle.hpp"
#include "plugins/common/scanner/rays.hpp"

namespace muro::raycast {

using scanner::direction_of;
using scanner::Grid;
using scanner::RaySet;

/// The rays of a scanner: their directions in the frame of the device, bundled.
class Pattern {
 public:
  explicit Pattern(const RaySet& rays);
  explicit Pattern(const Grid& grid) : Pattern(RaySet::of(grid)) {}
  /// Pairs of azimuth and elevation (rad).
  explicit Pattern(std::span<const double> azimuths_and_elevations) : Pattern(RaySet::of(azimuths_and_elevations)) {}

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

}  // namespace muro::raycast
