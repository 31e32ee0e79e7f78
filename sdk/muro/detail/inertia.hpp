// SPDX-License-Identifier: MIT
// Arithmetic of Inertia, included by geometry.hpp. Every source of muro compiles it, so it is written with numbers
// where Eigen's expressions would take long to compile.
#pragma once

#include "muro/geometry.hpp"

namespace muro {

inline Inertia Inertia::in(const Pose& pose) const {
  const Mat3 r = pose.orientation.toRotationMatrix();
  double turned[3][3] = {};  // r * tensor, then that * r^T
  for (int i = 0; i < 3; ++i) {
    const double x = r(i, 0), y = r(i, 1), z = r(i, 2);
    const double row[3] = {x * ixx + y * ixy + z * ixz, x * ixy + y * iyy + z * iyz, x * ixz + y * iyz + z * izz};
    for (int j = 0; j < 3; ++j) turned[i][j] = row[0] * r(j, 0) + row[1] * r(j, 1) + row[2] * r(j, 2);
  }
  return {mass, pose * com, turned[0][0], turned[1][1], turned[2][2], turned[0][1], turned[0][2], turned[1][2]};
}

inline Inertia Inertia::operator+(const Inertia& b) const {
  const double total = mass + b.mass;
  if (total <= 0) return {};
  Vec3 centre;
  for (int i = 0; i < 3; ++i) centre[i] = (mass * com[i] + b.mass * b.com[i]) / total;
  const Inertia f = moved_to(centre), g = b.moved_to(centre);
  return {total, centre, f.ixx + g.ixx, f.iyy + g.iyy, f.izz + g.izz, f.ixy + g.ixy, f.ixz + g.ixz, f.iyz + g.iyz};
}

inline Inertia Inertia::moved_to(const Vec3& centre) const {
  const double x = com.x() - centre.x(), y = com.y() - centre.y(), z = com.z() - centre.z();
  return {mass,
          centre,
          ixx + mass * (y * y + z * z),
          iyy + mass * (x * x + z * z),
          izz + mass * (x * x + y * y),
          ixy - mass * x * y,
          ixz - mass * x * z,
          iyz - mass * y * z};
}

}  // namespace muro
