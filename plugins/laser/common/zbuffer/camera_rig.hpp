// SPDX-License-Identifier: MIT
// Pinhole cameras with images that contain all rays of a scanner.
#pragma once

#include "plugins/common/render/camera.hpp"
#include "plugins/laser/common/scanner/rays.hpp"

namespace muro::zbuffer {

/// The position of a ray in an image.
struct RaySample {
  std::uint32_t camera = 0;
  double column = 0, row = 0;   ///< in the image of the camera, in pixels; whole numbers are centres of pixels
  double length_per_depth = 0;  ///< length of the ray by depth along the axis of the camera
};

/// A pinhole camera looks along x. Its pixels are evenly spaced on a plane, so that their angles become smaller towards
/// the sides (MuRoSimF, Section 4.1). A scan that is wider than `max_width` is seen by several cameras side by side.
/// Rays that point steeply up or down are seen by two more.
struct CameraRig {
  static constexpr double max_width = 1.6;      ///< rad, across
  static constexpr double max_elevation = 0.9;  ///< rad, up or down, limit of rays seen by the cameras side by side
  static constexpr std::uint32_t margin = 2;    ///< pixels around the rays, needed by interpolation

  std::vector<render::Camera> cameras;  ///< with their poses in the frame of the device
  std::vector<RaySample> samples;       ///< one for each ray

  /// `pixels`: lower bound for each ray, across and down, at the place where the pixels of a camera are widest apart.
  static CameraRig of(const scanner::RaySet& rays, double pixels);

  /// Return the size of all images, one below the other.
  std::uint32_t width() const;
  std::uint32_t height() const;
};

}  // namespace muro::zbuffer
