// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "model.hpp"

namespace muro::scip2 {

/// Directions of the rays of a simulated laser.
struct RayGrid {
  double min_angle = 0;        ///< rad, counter-clockwise; for the first ray of a row
  double angle_increment = 0;  ///< rad
  std::uint32_t columns = 1;
  std::uint32_t first_ray = 0;  ///< first ray of the row that is used
};

/// Values that a simulated laser reports for each ray at one instant.
struct LaserScan {
  std::span<const double> ranges;                              ///< m, as measured by the device
  std::span<const double> truth;                               ///< m, before errors; may be the same
  std::span<const double> incidence;                           ///< rad; may be empty
  double max_range = std::numeric_limits<double>::infinity();  ///< of the laser, m: its reading without return
};

/// Converts rays of a laser to readings of a device's steps.
class Readings {
 public:
  Readings(const Model& model, const RayGrid& grid);

  /// Returns the number of steps without a ray within half a ray spacing: they read 0.
  std::uint32_t steps_without_ray() const;
  /// Returns the number of rays for the angle of one step; below one, neighbouring steps use the same ray.
  double rays_per_step() const { return rays_per_step_; }

  /// Fills in mm or an error code, and the intensity, for each step from AMIN to AMAX.
  void read(const LaserScan& scan, std::span<std::uint32_t> distances, std::span<std::uint32_t> intensities) const;

 private:
  std::uint32_t distance(const LaserScan& scan, std::uint32_t ray) const;
  double cosine_of_incidence(std::span<const std::uint32_t> distances, std::size_t i) const;
  void mark_edges(std::span<std::uint32_t> distances) const;

  static constexpr std::uint32_t no_ray = ~0u;
  Model model_;
  double rays_per_step_ = 1;
  struct HalfAngle {
    double sine = 0, cosine = 1;
  };
  std::array<HalfAngle, 3> half_angles_;  ///< for zero, one and two steps
  std::vector<std::uint32_t> rays_;       ///< nearest ray of each step
};

/// Returns the intensity of a surface `d` m away, from the cosine of the angle of incidence a: 10000 cos a / (1 + (d /
/// m)^2).
std::uint32_t intensity_of(double distance, double cosine_of_incidence);

}  // namespace muro::scip2
