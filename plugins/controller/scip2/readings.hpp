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

/// Where the rays of a simulated laser look.
struct RayGrid {
  double min_angle = 0;        ///< rad, counter-clockwise; of the first ray of a row
  double angle_increment = 0;  ///< rad
  std::uint32_t columns = 1;
  std::uint32_t first_ray = 0;  ///< of the row that is looked at
};

/// What a simulated laser reports at one instant, for each ray.
struct LaserScan {
  std::span<const double> ranges;                              ///< m, as the device measures them
  std::span<const double> truth;                               ///< m, before errors; may be the same
  std::span<const double> incidence;                           ///< rad; may be empty
  double max_range = std::numeric_limits<double>::infinity();  ///< m, of the laser: what nothing reads
};

/// From the rays of a laser to what the steps of a device read.
class Readings {
 public:
  Readings(const Model& model, const RayGrid& grid);

  /// Steps within whose half spacing of rays there is no ray: they read 0.
  std::uint32_t steps_without_ray() const;
  /// Rays within a turn for one step; below one, neighbouring steps read the same ray.
  double rays_per_step() const { return rays_per_step_; }

  /// mm or an error code, and the intensity, for each step from AMIN to AMAX.
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
  std::array<HalfAngle, 3> half_angles_;  ///< of none, one and two steps
  std::vector<std::uint32_t> rays_;       ///< the nearest one of each step
};

/// The intensity of a reading `d` m away whose surface is met at an angle of that cosine: 10000 cos a / (1 + (d /
/// m)^2).
std::uint32_t intensity_of(double distance, double cosine_of_incidence);

}  // namespace muro::scip2
