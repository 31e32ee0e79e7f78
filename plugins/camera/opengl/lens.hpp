// SPDX-License-Identifier: MIT
// Lens distortion.
#pragma once

#include <array>
#include <vector>

#include "plugins/common/render/camera.hpp"

namespace muro::camera {

/// The distortion of Brown and Conrady with OpenCV's coefficients k1, k2, p1, p2, k3 ("plumb_bob" in ROS): a pinhole at
/// distance 1 sees a point at (x, y), x right and y down, the lens at
///
///     x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2)
///     y' = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y        r^2 = x^2 + y^2
///
/// (Brown, Decentering distortion of lenses, Photogrammetric Engineering 32, 1966).
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

  bool is_none() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
  Eigen::Vector2d distorted(const Eigen::Vector2d& p) const;
  /// Returns the point that is seen at `p`, by Newton's method; not a number if the lens sees none there.
  Eigen::Vector2d undistorted(const Eigen::Vector2d& p) const;
};

/// The position of each pixel of an image through a lens in the image of a pinhole camera.
struct LensMap {
  render::Camera pinhole;  ///< `camera` with a larger image
  struct Position {
    float column = -1, row = -1;  ///< whole numbers are centres of pixels; negative: the lens sees nothing there
  };
  std::vector<Position> positions;  ///< positions of the pixels of the image, row by row

  /// `camera`: camera of the image through the lens. Throws muro::Error if the pinhole image needs more than
  /// `max_pixels` along a side.
  static LensMap of(const render::Camera& camera, const Distortion& lens, std::uint32_t max_pixels);
};

}  // namespace muro::camera
