// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"
#include "muro/toolkit/contact_stop.hpp"

namespace muro::biped {

/// Plane on which feet are put: n . x = offset, solid below.
struct GroundPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit, points out of the ground
  double offset = 0;            ///< m
  ShapeOfObject shape;          ///< shape of the scenery that is the plane

  /// Returns the height of a point above the plane (m).
  double height(const Vec3& point) const { return normal.dot(point) - offset; }
};

/// Returns the plane of the object of this name among the collision shapes of the scenery. If the name is empty,
/// returns the only plane whose normal points up (to 84 deg off). Throws Error if the plane is not unique. [setup]
GroundPlane find_ground_plane(const Connector& c, std::string_view name);

}  // namespace muro::biped
