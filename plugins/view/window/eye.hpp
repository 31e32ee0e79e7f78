// SPDX-License-Identifier: MIT
#pragma once

#include "muro/geometry.hpp"

namespace muro::view {

/// From where the window looks, moved by the mouse. Angles in rad, lengths in m.
class Eye {
 public:
  enum class Mode {
    orbit,         ///< around a place
    follow,        ///< around something that moves, which stays where it is in the picture
    first_person,  ///< from something that moves, along its x axis
  };

  Mode mode = Mode::orbit;

  /// Looks at the middle of what lies between two corners, from the side, so far that all is seen.
  void look_at_all(const Vec3& low, const Vec3& high);
  void look_from(const Vec3& from, const Vec3& to);
  /// Mouse moved by so many pixels of a window that is `height` high.
  void turn(double across, double down, double height);
  void shift(double across, double down, double height, double fov);
  /// By notches of the wheel; towards what is looked at.
  void zoom(double notches);
  /// Where what it follows is now.
  void follow(const Pose& target);

  /// Of a camera: x along the line of sight, z up.
  Pose pose() const;
  const Vec3& middle() const { return middle_; }
  double distance() const { return distance_; }

 private:
  Quat turned() const;

  Vec3 middle_ = Vec3::Zero();
  double azimuth_ = 0.8, elevation_ = 0.5;  ///< of the eye, seen from the middle
  double distance_ = 5;
  Pose carrier_;  ///< first person
};

}  // namespace muro::view
