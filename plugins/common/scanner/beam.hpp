// SPDX-License-Identifier: MIT
// A beam that is wider than a line, as seven rays: its middle, and six around it.
#pragma once

#include <array>

#include "rays.hpp"

namespace muro::scanner {

/// What a device makes of a beam. The light that comes back from each seventh of the beam is as 1 / d^2 (all surfaces
/// are taken to be equally bright), and what is read is the mean of the distances d, each with that weight: where an
/// edge lies in the beam, a reading between both sides (a "mixed pixel"; Tang, Huber and Akinci, A comparative analysis
/// of depth-discontinuity and mixed-pixel detection algorithms, 3DIM 2007). What nothing comes back from has no weight.
class Beam {
 public:
  static constexpr std::uint32_t rays = 7;

  /// `divergence`: rad, the full angle of the cone; the rays around the middle stand for the outer part of its area.
  /// With 0 a reading is that of the middle alone, and the others tell its incidence.
  explicit Beam(double divergence);

  /// Every ray of `set` becomes seven, one behind the other.
  RaySet widened(const RaySet& set) const;

  struct Reading {
    double range = 0;        ///< m; nothing_from where nothing comes back
    double incidence = 0;    ///< rad, 0 .. pi/2, to the normal of the surface in the middle; 0 where nothing is
    std::uint32_t main = 0;  ///< the ray whose surface the reading is of
  };
  /// `ranges` (m) along the seven rays; from `nothing_from` on they mean that there was nothing.
  Reading read(const double* ranges, double nothing_from) const;

 private:
  bool is_line_;
  double tangent_;                                  ///< of the angle between the middle and the rays around it
  std::array<Eigen::Vector2d, rays - 1> around_{};  ///< their places on the plane at distance 1
};

}  // namespace muro::scanner
