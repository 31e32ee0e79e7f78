// SPDX-License-Identifier: MIT
// Rotations by vectors, by angles and between directions.
#pragma once

#include "muro/base/elementary.hpp"
#include "muro/geometry.hpp"

namespace muro {

/// The rotation by the vector `v` (axis times angle, rad).
inline Quat rotation_of(const Vec3& v) {
  const double x = 0.25 * v.squaredNorm();  // square of the half angle
  if (x < 0.01) {                           // series, exact to the last digit: the turns of single steps
    const double c = 1 - x / 2 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56 * (1 - x / 90))));
    const double s = 0.5 * (1 - x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72 * (1 - x / 110)))));
    return Quat(c, s * v.x(), s * v.y(), s * v.z());
  }
  const double half = std::sqrt(x);
  const auto [sine, cosine] = elementary::sincos(half);
  const double s = 0.5 * sine / half;
  return Quat(cosine, s * v.x(), s * v.y(), s * v.z());
}

/// The rotation about the unit vector `axis` by `angle` (rad).
inline Quat rotation_about(const Vec3& axis, double angle) {
  const auto [sine, cosine] = elementary::sincos(0.5 * angle);
  return Quat(cosine, sine * axis.x(), sine * axis.y(), sine * axis.z());
}

/// The angle (rad, 0 to pi) of the rotation by the unit quaternion `q`.
inline double angle_of(const Quat& q) { return 2 * elementary::atan2(q.vec().norm(), std::abs(q.w())); }

/// Returns the rotation by the unit quaternion `q` as a vector (axis times angle, rad, at most pi long): the inverse of
/// rotation_of.
inline Vec3 rotation_vector_of(const Quat& q) {
  const double sine = q.vec().norm(), sign = q.w() < 0 ? -1 : 1;
  if (sine < 1e-12) return (2 * sign) * q.vec();
  return (sign * 2 * elementary::atan2(sine, std::abs(q.w())) / sine) * q.vec();
}

/// The mean of the rotations by t * v for t in [0, 1] (v: axis times angle, rad): a body that turns by `v`
/// while its own frame moves at the constant velocity u travels screw_integral(v) * u per unit of time.
inline Mat3 screw_integral(const Vec3& v) {
  const double angle2 = v.squaredNorm(), angle = std::sqrt(angle2);
  const bool small = angle < 1e-3;  // series, since the quotients lose digits
  const auto [sine, cosine] = small ? elementary::SinCos{} : elementary::sincos(angle);
  const double a = small ? 0.5 - angle2 / 24 : (1 - cosine) / angle2;
  const double b = small ? 1.0 / 6 - angle2 / 120 : (angle - sine) / (angle2 * angle);
  const double x = v.x(), y = v.y(), z = v.z();  // 1 + a [v] + b [v]^2, with [v]^2 = v v^T - |v|^2
  Mat3 mean;
  mean << 1 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y,  //
      b * x * y + a * z, 1 - b * (x * x + z * z), b * y * z - a * x,      //
      b * x * z - a * y, b * y * z + a * x, 1 - b * (x * x + y * y);
  return mean;
}

/// Rotation angle (rad) about the z axis: the yaw of roll, pitch and yaw.
inline double yaw_of(const Quat& q) {
  return elementary::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
}

/// Fixed-axis roll, pitch, yaw (rad), as in URDF: Rz(yaw) Ry(pitch) Rx(roll).
inline Quat from_rpy(double roll, double pitch, double yaw) {
  return rotation_about(Vec3::UnitZ(), yaw) * rotation_about(Vec3::UnitY(), pitch) *
         rotation_about(Vec3::UnitX(), roll);
}

/// The shortest turn that takes the direction `from` to the direction `to` (unit vectors).
inline Quat turn_between(const Vec3& from, const Vec3& to) {
  const double w = 1 + from.x() * to.x() + from.y() * to.y() + from.z() * to.z();
  if (w < 1e-14) {  // opposite: half a turn about any perpendicular axis
    const bool along_x = std::abs(from.x()) > 0.7;
    const double x = along_x ? from.z() : 0, y = along_x ? 0 : from.z(), z = along_x ? -from.x() : -from.y();
    const double size = std::sqrt(x * x + y * y + z * z);
    return Quat(0, x / size, y / size, z / size);
  }
  const double x = from.y() * to.z() - from.z() * to.y(), y = from.z() * to.x() - from.x() * to.z(),
               z = from.x() * to.y() - from.y() * to.x(), size = std::sqrt(x * x + y * y + z * z + w * w);
  return Quat(w / size, x / size, y / size, z / size);
}

}  // namespace muro
