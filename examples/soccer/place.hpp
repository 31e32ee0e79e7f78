// SPDX-License-Identifier: MIT
// Points, and places with a heading, on level ground (m, rad), and the command of a walk.
#pragma once

#include <cmath>

#include "muro_elementary.h"

namespace soccer {

struct Point {
  double x = 0, y = 0;
  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double s, const Point& p) { return {s * p.x, s * p.y}; }
  friend double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
  double norm() const { return std::sqrt(x * x + y * y); }
};
struct Place {
  Point at;
  double yaw = 0;

  /// Converts from its own frame, x ahead and y to the left, to the frame in which it is given, and back.
  Point to_world(const Point& p) const {
    const double c = muro_cos(yaw), s = muro_sin(yaw);
    return at + Point{c * p.x - s * p.y, s * p.x + c * p.y};
  }
  Point to_own(const Point& p) const {
    const double c = muro_cos(yaw), s = muro_sin(yaw);
    const Point d = p - at;
    return {c * d.x + s * d.y, c * d.y - s * d.x};
  }
};
/// `walk.command`: forward, to the left (m/s), turn (rad/s).
struct Command {
  double x = 0, y = 0, turn = 0;
};
/// Returns the same direction within half a turn, rad.
inline double wrapped(double angle) { return std::remainder(angle, 2 * 3.14159265358979323846); }

}  // namespace soccer
