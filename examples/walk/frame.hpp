// SPDX-License-Identifier: MIT
// Rotations about the axes, rad, and frames: x forward, y left, z up (REP-103).
#pragma once

#include "../common/vector.hpp"
#include "muro_elementary.h"  // sines with equal bits on every machine

namespace walking {

using examples::Rotation;
using examples::Vector;

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
  Frame inverse() const { return {rotation.inverse(), rotation.inverse() * -origin}; }
};

}  // namespace walking
