// SPDX-License-Identifier: MIT
// Vectors and rotation matrices of control code, without a library: x forward, y left, z up (REP-103), angles in rad.
#pragma once

#include <cmath>

#include "muro_elementary.h"  // sines with equal bits on every machine

namespace walking {

inline constexpr double gravity = 9.81;  // m/s^2

struct Vector {
  double x = 0, y = 0, z = 0;

  Vector operator+(const Vector& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vector operator-(const Vector& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vector operator*(double s) const { return {x * s, y * s, z * s}; }
  double dot(const Vector& o) const { return x * o.x + y * o.y + z * o.z; }
  Vector cross(const Vector& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
  double norm() const { return std::sqrt(dot(*this)); }
};

/// A rotation. Its columns are the axes of the turned frame.
struct Rotation {
  Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vector operator*(const Vector& v) const { return x * v.x + y * v.y + z * v.z; }
  Rotation operator*(const Rotation& o) const { return {*this * o.x, *this * o.y, *this * o.z}; }
  Rotation inverse() const { return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}; }
};

inline Rotation about_x(double angle) {
  double s, c;
  muro_sincos(angle, &s, &c);
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
}
inline Rotation about_y(double angle) {
  double s, c;
  muro_sincos(angle, &s, &c);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}
inline Rotation about_z(double angle) {
  double s, c;
  muro_sincos(angle, &s, &c);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

/// A frame in another one.
struct Frame {
  Rotation rotation;
  Vector origin;

  Frame operator*(const Frame& o) const { return {rotation * o.rotation, origin + rotation * o.origin}; }
  Frame inverse() const { return {rotation.inverse(), rotation.inverse() * (origin * -1)}; }
};

}  // namespace walking
