// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "plugins/laser/common/scanner/rays.hpp"
#include "ray_packet.hpp"

namespace muro::raycast {

using scanner::direction_of;
using scanner::Grid;
using scanner::RaySet;

/// The rays of a scanner: directions in the frame of the device, in packets.
class RayPattern {
 public:
  explicit RayPattern(const RaySet& rays);
  explicit RayPattern(const Grid& grid) : RayPattern(RaySet::of(grid)) {}
  /// `azimuths_and_elevations`: pairs, rad.
  explicit RayPattern(std::span<const double> azimuths_and_elevations)
      : RayPattern(RaySet::of(azimuths_and_elevations)) {}

  std::uint32_t size() const { return size_; }
  std::span<const RayPacket> packets() const { return packets_; }
  std::span<const Sector> sectors() const { return sectors_; }
  /// Return the least and greatest z / sqrt(x^2 + y^2) of the rays; infinite for a ray along the z axis.
  double min_slope() const { return min_slope_; }
  double max_slope() const { return max_slope_; }

 private:
  void add(const Vec3& direction, std::uint32_t ray, RayPacket& packet);
  void finish(RayPacket& packet);
  void make_sectors();

  std::uint32_t size_ = 0;
  std::vector<RayPacket> packets_;
  std::vector<Sector> sectors_;
  double min_slope_ = 0, max_slope_ = 0;
};

}  // namespace muro::raycast
