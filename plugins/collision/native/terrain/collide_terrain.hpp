// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "terrain/solid.hpp"
#include "terrain/terrain.hpp"

namespace muro::native {

/// Adds where a convex shape and the ground below a heightmap overlap, the normals upward, in the world: points of the
/// shape against the triangles below them, and convex edges and peaks of the surface against its sides. What is deep in
/// the ground is pushed up. `is_left`: it is known that lanes::TerrainPoints cannot tell; it is asked otherwise, and
/// gives the same.
void collide_terrain(const TransformedShape& shape, const Terrain& terrain, std::vector<ContactPoint>& points,
                     bool is_left = false);
/// The same of a hull at a pose; `box`: around it.
void collide_terrain(const TransformedShape& box, const CollisionGeometry& hull, const HullSupport& support,
                     const Pose& pose, const Terrain& terrain, std::vector<ContactPoint>& points, bool is_left = false);

}  // namespace muro::native
