// SPDX-License-Identifier: MIT
// Pinhole pictures that hold all rays of a scanner.
#pragma once

#include "plugins/common/render/camera.hpp"
#include "plugins/common/scanner/rays.hpp"

namespace muro::zbuffer {

/// Where a ray finds its distance.
struct Sample {
  std::uint32_t view = 0;
  double column = 0, row = 0;  ///< place in the view's picture, in pixels: whole numbers are middles of pixels
  double per_depth = 0;        ///< length of the ray by depth along the view's axis
};

/// The pinhole looks along x, and its pixels lie evenly on a plane, so that they are closer in angle towards its sides
/// (MuRoSimF, Section 4.1). A scan that is wider than `widest` is seen by several pinholes side by side, and rays that
/// look steeply up or down by two more.
struct Views {
  static constexpr double widest = 1.6;    ///< rad, across
  static constexpr double steepest = 0.9;  ///< rad, of rays in the pictures that lie side by side

  /// `cameras` have their pose in the frame of the device. The rays of a view lie at least `margin` pixels inside of
  /// its picture, so that all that interpolation asks for is there.
  std::vector<render::Camera> cameras;
  std::vector<Sample> samples;  ///< one a ray

  static constexpr std::uint32_t margin = 2;
  /// `pixels`: at least so many a ray, across and down, where the pixels of a view are widest apart.
  static Views of(const scanner::RaySet& rays, double pixels);

  /// Of all pictures, one below the other.
  std::uint32_t width() const;
  std::uint32_t height() const;
};

}  // namespace muro::zbuffer
