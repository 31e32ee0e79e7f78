// SPDX-License-Identifier: MIT
// The pinhole camera: Hartley and Zisserman, Multiple View Geometry, 2nd edition, section 6.1.
#pragma once

#include <cstdint>

#include "muro/base/elementary.hpp"
#include "muro/object.hpp"

namespace muro::render {

/// A pinhole camera. A point at x forward, y left, z up in its frame is seen at column cx - fx y/x and row cy - fy z/x,
/// counted from the upper left corner of the image, in pixels. The first pixel reaches from 0 to 1.
struct Camera {
  Pose pose;                            ///< in the world; the camera looks along x
  std::uint32_t width = 0, height = 0;  ///< pixels
  double fx = 0, fy = 0;                ///< pixels
  double cx = 0, cy = 0;                ///< pixels
  double near = 0.01;                   ///< m along the axis; nothing nearer is seen
  double far = 1000;                    ///< m along the axis; nothing farther is seen
  RobotId ignored_robot = no_robot;     ///< a robot that is not seen

  /// Returns a camera with square pixels and the axis in the middle. `fov`: horizontal, rad, below pi.
  static Camera of_fov(std::uint32_t width, std::uint32_t height, double fov) {
    Camera c;
    c.width = width;
    c.height = height;
    c.fx = c.fy = 0.5 * width / elementary::tan(0.5 * fov);
    c.cx = 0.5 * width;
    c.cy = 0.5 * height;
    return c;
  }
};

/// Returns the camera's axes in those of the world. Rows: right, up, forward.
inline Mat3 axes_of(const Camera& c) {
  const Mat3 r = c.pose.orientation.toRotationMatrix();
  Mat3 axes;
  axes << -r.col(1).transpose(), r.col(2).transpose(), r.col(0).transpose();
  return axes;
}

}  // namespace muro::render
