// SPDX-License-Identifier: MIT
// Motion of a frame in its own x-y plane.
#pragma once

#include "muro/base/elementary.hpp"
#include "muro/geometry.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::wheels {

/// Velocity of the frame's origin in the frame's own axes, and turn rate about its z axis. Also used for a rate of
/// change of these, and for a row or column of a Jacobian.
struct PlanarTwist {
  double x = 0, y = 0;  ///< m/s
  double yaw_rate = 0;  ///< rad/s

  PlanarTwist operator+(const PlanarTwist& b) const { return {x + b.x, y + b.y, yaw_rate + b.yaw_rate}; }
  PlanarTwist operator*(double k) const { return {k * x, k * y, k * yaw_rate}; }
  bool operator==(const PlanarTwist&) const = default;
};

inline double dot(const PlanarTwist& a, const PlanarTwist& b) {
  return a.x * b.x + a.y * b.y + a.yaw_rate * b.yaw_rate;
}

/// Returns the part of a body's velocity (world axes) that lies in its own x-y plane.
inline PlanarTwist in_plane(const Pose& pose, const Twist& v) {
  const Quat to_body = pose.orientation.conjugate();
  const Vec3 linear = to_body * v.linear;
  return {linear.x(), linear.y(), (to_body * v.angular).z()};
}

/// Returns the velocity `v` of a frame at `pose`, in the axes of the world.
inline Twist in_world(const Pose& pose, const PlanarTwist& v) {
  return {pose.orientation * Vec3(v.x, v.y, 0), pose.orientation * Vec3(0, 0, v.yaw_rate)};
}

/// Returns the pose, in the frame's pose before, after the constant `v` for `dt` (s): an arc. Its chord has the length
/// v dt sin(h) / h and the angle h to the heading at the start, where h is half the angle of the turn.
inline Pose arc(const PlanarTwist& v, double dt) {
  const double half = 0.5 * v.yaw_rate * dt;
  const auto [s, c] = elementary::sincos(half);
  const double chord = half == 0 ? dt : dt * s / half;
  return {{chord * (c * v.x - s * v.y), chord * (s * v.x + c * v.y), 0}, Quat(c, 0, 0, s)};
}

/// Returns the pose as `arc` does, for a velocity that is `v` at first and has the constant rate `acceleration`. The
/// heading is exact. The position, a Fresnel integral, is found by Gauss and Legendre's rule of five points: exact to
/// 1e-10 of the length of the path for turns up to 1 rad.
inline Pose accelerated_arc(const PlanarTwist& v, const PlanarTwist& acceleration, double dt) {
  constexpr double nodes[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  constexpr double weights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                0.2369268850561891};
  const auto heading = [&](double t) { return t * (v.yaw_rate + 0.5 * t * acceleration.yaw_rate); };
  Vec3 displacement = Vec3::Zero();
  for (int i = 0; i < 5; ++i) {
    const double t = 0.5 * dt * (1 + nodes[i]);
    const auto [s, c] = elementary::sincos(heading(t));
    const PlanarTwist now = v + acceleration * t;
    displacement += 0.5 * dt * weights[i] * Vec3(c * now.x - s * now.y, s * now.x + c * now.y, 0);
  }
  return {displacement, rotation_about(Vec3::UnitZ(), heading(dt))};
}

}  // namespace muro::wheels
