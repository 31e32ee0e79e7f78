// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"

namespace muro::view {

/// The camera of the window, moved by the mouse. Angles in rad, lengths in m.
class OrbitCamera {
 public:
  enum class Mode {
    orbit,         ///< around a fixed point
    follow,        ///< around a moving object, which keeps its position in the image
    first_person,  ///< from a moving object, along its x axis
  };

  Mode mode = Mode::orbit;

  /// Looks at the centre of a box, given by two corners, from so far that all of it is seen.
  void show_box(const Vec3& low, const Vec3& high);
  void look_from(const Vec3& from, const Vec3& to);
  /// For a mouse movement in pixels of a window that is `height` pixels high.
  void rotate(double across, double down, double height);
  void shift(double across, double down, double height, double fov);
  /// By notches of the mouse wheel, towards the target.
  void zoom(double notches);
  /// The present pose of the followed object.
  void follow(const Pose& target);
  /// Goes this part (0 to 1) of the way to looking at a ball from so far that all of it is seen; the direction stays,
  /// and the distance where `keeps_distance`.
  void approach(const Vec3& middle, double radius, double part, bool keeps_distance);

  /// Frame of the camera: x along the line of sight, z up.
  Pose pose() const;
  const Vec3& target() const { return target_; }
  double distance() const { return distance_; }

 private:
  Quat orientation() const;

  Vec3 target_ = Vec3::Zero();
  double azimuth_ = 0.8, elevation_ = 0.5;  ///< of the camera as seen from the target
  double distance_ = 5;
  Pose carrier_;  ///< of the first-person view
};

}  // namespace muro::view
