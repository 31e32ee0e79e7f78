// SPDX-License-Identifier: MIT
#pragma once

#include "collision_object.hpp"

namespace muro::contact_geometry {

/// Returns the direction of the minimum translation that separates `a` from `b`, as far as a search finds it. It starts
/// from the best of `start` (unit, from b to a), the normals of flat faces, and the directions at right angles to an
/// edge or axis of one or both, and improves it by gradient descent. The depth along n is the support function of the
/// Minkowski difference, h(n) = n . (p_b(n) - p_a(-n)), with the gradient p_b - p_a, the difference of the support
/// points. Both are convex, neither is a plane. For engines that find whether shapes overlap, but not the least depth.
Vec3 minimum_translation_direction(const CollisionObject& a, const CollisionObject& b, const Vec3& start);

}  // namespace muro::contact_geometry
