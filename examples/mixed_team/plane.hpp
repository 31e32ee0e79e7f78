// SPDX-License-Identifier: MIT
// Points and headings on the map of the team: x east, y north, m; rad counter-clockwise from x.
#pragma once

#include <cmath>
#include <span>

#include "muro_elementary.h"

namespace mixed_team {

struct Point {
  double x = 0, y = 0;
  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double s, const Point& p) { return {s * p.x, s * p.y}; }
};

inline double length(const Point& p) { return std::sqrt(p.x * p.x + p.y * p.y); }
inline double distance(const Point& a, const Point& b) { return length(a - b); }
inline double bearing(const Point& p) { return muro_atan2(p.y, p.x); }
/// Turns counter-clockwise: from the axes of a robot with that heading to the axes of the map.
inline Point turned(const Point& p, double yaw) {
  const double c = muro_cos(yaw), s = muro_sin(yaw);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}
/// Returns the same direction within half a turn.
inline double wrapped(double angle) { return std::remainder(angle, 2 * 3.14159265358979323846); }
/// Returns the yaw of a unit quaternion x, y, z, w.
inline double yaw_of(std::span<const double> q) {
  return muro_atan2(2 * (q[3] * q[2] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2]));
}

}  // namespace mixed_team
