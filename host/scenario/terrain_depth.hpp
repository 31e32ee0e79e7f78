// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/shape.hpp"
#include "muro/toolkit/heightmap.hpp"

namespace muro::host {

/// Returns how deep (m, along the normal of the surface) a shape is below the surface of a heightmap; below 0 when it
/// is above. `in_map`: pose of the shape in the frame of the map. Found from its corners, or for a round shape from the
/// point that is furthest against the normal below its centre. `corners`: corners of a mesh.
double depth_below(const Heightmap& map, const Pose& in_map, const Shape& shape, std::span<const Vec3> corners);

}  // namespace muro::host
