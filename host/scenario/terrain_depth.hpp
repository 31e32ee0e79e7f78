// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/shape.hpp"
#include "muro/toolkit/heightmap.hpp"

namespace muro::host {

/// How deep (m, along the normal of the surface) a shape reaches below a heightmap, above which it is at `in_map`;
/// below 0: it does not. By its corners, or where it is round by the point that is furthest against the normal below
/// its centre. `corners`: of a mesh.
double depth_below(const Heightmap& map, const Pose& in_map, const Shape& shape, std::span<const Vec3> corners);

}  // namespace muro::host
