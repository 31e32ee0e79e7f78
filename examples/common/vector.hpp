// SPDX-License-Identifier: MIT
// Vectors and rotations in space, for control code that needs nothing but a compiler: x forward, y left, z up
// (REP-103).
#pragma once

#include <cmath>
#include <span>

#include "muro_elementary.h"  // sines with equal bits on every machine

namespace examples {

struct Vector {
  double x = 0, y = 0, z = 0;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
  friend Vector operator*(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  double norm() const { return std::sqrt(dot(*this, *this)); }
};

/// A rotation. Its columns are the axes of the turned frame.
struct Rotation {
  Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  /// Returns the rotation of a unit quaternion x, y, z, w.
  static Rotation of(std::span<const double> q) {
    const double a = q[0], b = q[1], c = q[2], w = q[3];
    return {{1 - 2 * (b * b + c * c), 2 * (a * b + w * c), 2 * (a * c - w * b)},
            {2 * (a * b - w * c), 1 - 2 * (a * a + c * c), 2 * (b * c + w * a)},
            {2 * (a * c + w * b), 2 * (b * c - w * a), 1 - 2 * (a * a + b * b)}};
  }
  Vector operator*(const Vector& v) const { return v.x * x + v.y * y + v.z * z; }
  Rotation operator*(const Rotation& o) const { return {*this * o.x, *this * o.y, *this * o.z}; }
  Rotation inverse() const { return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}; }
  /// Returns the vertical in the turned frame.
  Vector up() const { return {x.z, y.z, z.z}; }
};

/// Returns the rotation without its `yaw` (rad): from the turned frame to a level frame with the same heading.
inline Rotation levelled(const Rotation& r, double yaw) {
  const double c = muro_cos(yaw), s = muro_sin(yaw);
  const auto back = [&](const Vector& v) { return Vector{c * v.x + s * v.y, c * v.y - s * v.x, v.z}; };
  return {back(r.x), back(r.y), back(r.z)};
}

}  // namespace examples
