// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"
#include "muro/toolkit/contact_stop.hpp"

namespace muro::biped {

/// The plane on which feet are put: n . x = offset, solid below.
struct GroundPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit, out of the ground
  double offset = 0;            ///< m
  ShapeOfObject shape;          ///< which it is

  /// m, of a point above it.
  double height(const Vec3& point) const { return normal.dot(point) - offset; }
};

/// The plane of the object of this name among the collision shapes of the scenery; empty: the only one that
/// looks up (to 84 deg off). Throws
/// Error where it is not clear which. [setup]
GroundPlane find_ground_plane(const Connector& c, std::string_view name);

}  // namespace muro::biped
