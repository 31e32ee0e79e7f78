// SPDX-License-Identifier: MIT
// Points and places on level ground: m, rad counter-clockwise from x.
#pragma once

#include <cmath>

#include "muro_elementary.h"

namespace examples {

struct Point {
  double x = 0, y = 0;

  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double s, const Point& p) { return {s * p.x, s * p.y}; }
  friend double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
  double norm() const { return std::sqrt(x * x + y * y); }
};

inline double distance(const Point& a, const Point& b) { return (a - b).norm(); }
/// Returns the direction in which the origin sees a point.
inline double bearing(const Point& p) { return muro_atan2(p.y, p.x); }
/// Turns counter-clockwise about the origin: from the axes of a robot with this yaw to the axes of the ground.
inline Point turned(const Point& p, double yaw) {
  const double c = muro_cos(yaw), s = muro_sin(yaw);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// Place of a robot.
struct Place {
  Point at;
  double yaw = 0;

  /// Converts from its own frame, x ahead and y to the left, to the frame in which it is given, and back.
  Point to_world(const Point& p) const { return at + turned(p, yaw); }
  Point to_own(const Point& p) const {
    const double c = muro_cos(yaw), s = muro_sin(yaw);
    const Point d = p - at;
    return {c * d.x + s * d.y, c * d.y - s * d.x};
  }
};

}  // namespace examples
