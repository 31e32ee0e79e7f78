// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"

namespace muro::view {

/// The camera of the window, moved by the mouse. Angles in rad, lengths in m.
class OrbitCamera {
 public:
  enum class Mode {
    orbit,         ///< turns around a fixed point
    follow,        ///< turns around a moving object, which keeps its position in the image
    first_person,  ///< looks from a moving object along its x axis
  };

  Mode mode = Mode::orbit;

  /// Looks at the centre of a box, given by two corners, from a distance at which all of it is visible.
  void show_box(const Vec3& low, const Vec3& high);
  void look_from(const Vec3& from, const Vec3& to);
  /// Turns by a mouse movement in pixels, in a window that is `height` pixels high.
  void rotate(double across, double down, double height);
  void shift(double across, double down, double height, double fov);
  /// Moves towards the target by notches of the mouse wheel.
  void zoom(double notches);
  /// Takes the present pose of the followed object.
  void follow(const Pose& target);
  /// Moves by `part` (0 to 1) towards a view in which all of a ball is visible. The direction stays; the distance stays
  /// when `keeps_distance` is true.
  void approach(const Vec3& middle, double radius, double part, bool keeps_distance);

  /// Frame of the camera: x along the line of sight, z up.
  Pose pose() const;
  const Vec3& target() const { return target_; }
  double distance() const { return distance_; }

 private:
  Quat orientation() const;

  Vec3 target_ = Vec3::Zero();
  double azimuth_ = 0.8, elevation_ = 0.5;  ///< direction of the camera, seen from the target
  double distance_ = 5;
  Pose carrier_;  ///< pose of the followed object, for the first-person view
};

}  // namespace muro::view
