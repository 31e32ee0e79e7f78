// SPDX-License-Identifier: MIT
// The view of a camera in the head of a humanoid: from pixels to points on the ground and back. Frames: x forward, y
// left, z up. The heading frame has its origin on the ground below the trunk, and turns with the trunk about the
// vertical axis only.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "../common/vector.hpp"
#include "muro_elementary.h"

namespace soccer {

using examples::Rotation;
using examples::Vector;

struct Pixel {
  double u = 0, v = 0;  ///< columns and rows, from the upper left corner
};

/// Focal lengths and centre of a pinhole camera: px.
struct Lens {
  double fx = 1, fy = 1, cx = 0, cy = 0;
};

/// Dimensions of a head: m, each in the frame of the previous part.
struct Head {
  Vector neck;    ///< axis of the pan joint, from the trunk's origin
  Vector tilt;    ///< axis of the tilt joint, from the pan joint
  Vector camera;  ///< camera, from the tilt joint
};

class CameraView {
 public:
  /// `trunk_height`: m, height of the trunk's origin above the ground; `orientation`: of the trunk, x y z w; `pan`,
  /// `tilt`: rad.
  CameraView(const Lens& lens, const Head& head, double trunk_height, std::span<const double> orientation, double pan,
             double tilt)
      : lens_(lens) {
    const Vector up = Rotation::of(orientation).up();
    const Vector level = Vector{1, 0, 0} - up.x * up;
    const Vector ahead = (1 / std::sqrt(dot(level, level))) * level, left = cross(up, ahead);
    const auto levelled = [&](const Vector& v) { return Vector{dot(v, ahead), dot(v, left), dot(v, up)}; };
    const double cp = muro_cos(pan), sp = muro_sin(pan), ct = muro_cos(tilt), st = muro_sin(tilt);
    const Vector forward{cp * ct, sp * ct, -st}, leftwards{-sp, cp, 0}, upwards{cp * st, sp * st, ct};
    const Vector place = head.neck +
                         Vector{cp * head.tilt.x - sp * head.tilt.y, sp * head.tilt.x + cp * head.tilt.y, head.tilt.z} +
                         head.camera.x * forward + head.camera.y * leftwards + head.camera.z * upwards;
    forward_ = levelled(forward), left_ = levelled(leftwards), up_ = levelled(upwards);
    place_ = levelled(place);
    place_.z += trunk_height;
    is_upright_ = up.z > 0.94;  // within 20 degrees
  }

  /// Point at `height` (m) above the ground that is seen at a pixel, in the heading frame; none above the horizon.
  std::optional<Vector> at_height(const Pixel& p, double height) const {
    const Vector ray = forward_ + ((lens_.cx - p.u) / lens_.fx) * left_ + ((lens_.cy - p.v) / lens_.fy) * up_;
    constexpr double flat = 0.01;  // least sine of the slope: farther away than a hundred times the height
    if (ray.z > -flat * std::sqrt(dot(ray, ray))) return std::nullopt;
    return place_ + ((height - place_.z) / ray.z) * ray;
  }
  /// Returns the pixel at which a point of the heading frame is seen; nothing behind the camera.
  std::optional<Pixel> pixel_of(const Vector& point) const {
    const Vector d = point - place_;
    const double depth = dot(d, forward_);
    if (depth < 0.01) return std::nullopt;
    return Pixel{lens_.cx - lens_.fx * dot(d, left_) / depth, lens_.cy - lens_.fy * dot(d, up_) / depth};
  }
  /// Returns how far an upright object that is seen at a pixel extends in the picture (px), for each metre of height,
  /// at a depth of one metre.
  Pixel upright_at(const Pixel& p) const {
    return {-lens_.fx * left_.z - (p.u - lens_.cx) * forward_.z, -lens_.fy * up_.z - (p.v - lens_.cy) * forward_.z};
  }
  /// Returns the row (px) of a column in which points as high as the camera are seen.
  double horizon(double u) const {
    return lens_.cy + lens_.fy * (forward_.z + ((lens_.cx - u) / lens_.fx) * left_.z) / up_.z;
  }
  /// Whether the trunk is upright. In a fall or on the ground, the camera is not where this class assumes it.
  bool is_upright() const { return is_upright_; }
  /// Returns the depth of a point (m) along the axis of the camera.
  double depth_of(const Vector& point) const { return dot(point - place_, forward_); }
  const Lens& lens() const { return lens_; }

 private:
  Lens lens_;
  Vector forward_, left_, up_;  ///< axes of the camera
  Vector place_;                ///< m
  bool is_upright_ = true;
};

}  // namespace soccer
