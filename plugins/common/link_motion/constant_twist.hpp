// SPDX-License-Identifier: MIT
// Poses along the path of a body whose twist is constant in its own axes: a screw motion (Murray, Li and Sastry, A
// Mathematical Introduction to Robotic Manipulation, 1994, section 2.3).
#pragma once

#include "muro/geometry.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::constant_twist {

/// Returns the pose of a body at `pose` after a motion with a constant twist. `rotation` (rad, axis times angle) and
/// `translation` (m): that twist times the duration, in the axes of the body.
inline Pose advanced(const Pose& pose, const Vec3& rotation, const Vec3& translation) {
  return pose * Pose{screw_integral(rotation) * translation, rotation_of(rotation)};
}

/// Returns the pose at `fraction` (0..1) of the screw motion from `a` to `b`. Their orientations differ by less than
/// half a turn.
inline Pose interpolated(const Pose& a, const Pose& b, double fraction) {
  const Vec3 rotation = rotation_vector_of(a.orientation.conjugate() * b.orientation);
  const Vec3 displacement = a.orientation.conjugate() * Vec3(b.position - a.position);
  const Vec3 translation = screw_integral(rotation).inverse() * displacement;
  Pose p = advanced(a, fraction * rotation, fraction * translation);
  p.orientation.normalize();
  return p;
}

}  // namespace muro::constant_twist
