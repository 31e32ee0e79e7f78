// SPDX-License-Identifier: MIT
// Vectors and rotations in three dimensions, for control code that needs nothing but a compiler.
#pragma once

#include <cmath>
#include <span>

#include "muro_elementary.h"

namespace quadruped {

struct Vector {
  double x = 0, y = 0, z = 0;
};

inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
inline Vector operator*(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Rotation {
  Vector rows[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  /// Returns the rotation of a unit quaternion x, y, z, w.
  static Rotation of(std::span<const double> q) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
             {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
             {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
  }
  Vector operator*(const Vector& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  /// Returns a vector turned by the inverse rotation.
  Vector back(const Vector& v) const { return v.x * rows[0] + v.y * rows[1] + v.z * rows[2]; }
};

/// Angles about the fixed axes x, y, z in this order (REP-103), rad.
struct Angles {
  double roll = 0, pitch = 0, yaw = 0;

  static Angles of(const Rotation& r) {
    const double sine = std::fmin(1, std::fmax(-1, -r.rows[2].x));
    return {muro_atan2(r.rows[2].y, r.rows[2].z), muro_asin(sine), muro_atan2(r.rows[1].x, r.rows[0].x)};
  }
};

/// Returns the rotation without its yaw: from the frame of the body to a level frame with its heading.
inline Rotation levelled(const Rotation& r, double yaw) {
  const double c = muro_cos(yaw), s = muro_sin(yaw);
  return {{c * r.rows[0] + s * r.rows[1], c * r.rows[1] - s * r.rows[0], r.rows[2]}};
}

}  // namespace quadruped
