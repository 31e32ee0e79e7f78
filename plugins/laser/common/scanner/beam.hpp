// SPDX-License-Identifier: MIT
// A beam with a divergence, sampled by seven rays: a central ray and a ring of six.
#pragma once

#include <array>

#include "rays.hpp"

namespace muro::scanner {

/// Model of how a device reads a beam. The light that returns from each seventh of the beam is proportional to 1 / d^2
/// (all surfaces are equally bright). The reading is the mean of the distances d with these weights. If there is an
/// edge in the beam, the reading is between both sides (a "mixed pixel"; Tang, Huber and Akinci, A comparative analysis
/// of depth-discontinuity and mixed-pixel detection algorithms, 3DIM 2007). Rays without a return have no weight.
class Beam {
 public:
  static constexpr std::uint32_t rays = 7;

  /// `divergence`: rad, the full angle of the cone; the ring represents the outer part of its area. If it is 0, the
  /// range is that of the central ray only, and the ring only measures the incidence.
  explicit Beam(double divergence);

  /// Returns a set with seven rays for each ray of `set`, stored one after the other.
  RaySet widened(const RaySet& set) const;

  struct Reading {
    double range = 0;            ///< m; no_return if no light returns
    double incidence = 0;        ///< rad, 0 .. pi/2: of the central ray to the normal of its surface; 0: no surface
    std::uint32_t main_ray = 0;  ///< ray that hits the object of the reading
  };
  /// `ranges`: m, along the seven rays; values of `no_return` and more mean that the ray met no surface.
  Reading read(const double* ranges, double no_return) const;

 private:
  bool is_line_;
  double tangent_;                                ///< tangent of the angle between the central ray and the ring
  std::array<Eigen::Vector2d, rays - 1> ring_{};  ///< positions of the ring on the plane at distance 1
};

}  // namespace muro::scanner
