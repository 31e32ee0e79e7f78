// SPDX-License-Identifier: MIT
#pragma once

#include "hulls/convex_core.hpp"
#include "plugins/common/contact_geometry/engine.hpp"

namespace muro::native {

/// Adds a contact for each triangle of an exact mesh that a convex shape overlaps: the least translation that separates
/// the two, and a point of the patch in which they touch. `core`: core of the shape.
void find_triangles(const CollisionObject& shape, const ConvexCore& core, const CollisionObject& mesh,
                    std::vector<EngineContact>& found);

}  // namespace muro::native
