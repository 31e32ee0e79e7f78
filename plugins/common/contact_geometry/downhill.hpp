// SPDX-License-Identifier: MIT
#pragma once

#include "solid.hpp"

namespace muro::encounters {

/// The direction in which `a` has the least way to go to be clear of `b`, as far as a search finds it: the best of
/// `start` (unit, from b to a), of the normals of flat faces and of what is at right angles to an edge or axis of one
/// or both, and from there downhill. How far it must go along n is the support function of the Minkowski difference,
/// h(n) = n . (p_b(n) - p_a(-n)), whose gradient is p_b - p_a, the outermost points. Both are convex, neither a plane.
/// For engines that tell touching from not touching but not the least depth.
Vec3 least_direction(const Standing& a, const Standing& b, const Vec3& start);

}  // namespace muro::encounters
