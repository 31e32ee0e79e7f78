// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "terrain/solid.hpp"
#include "terrain/terrain.hpp"

namespace muro::native {

/// Adds the points where a convex shape and the ground below a heightmap overlap, in the world, with normals upward.
/// These are points of the shape against the triangles below them, and convex edges and peaks of the surface against
/// the sides of the shape. A shape that is deep in the ground is pushed up. `is_left`: it is known that
/// lanes::TerrainPoints cannot find the points. Otherwise it is tried first; the result is the same.
void collide_terrain(const TransformedShape& shape, const Terrain& terrain, std::vector<ContactPoint>& points,
                     bool is_left = false);
/// Adds the same points for a hull at a pose. `box`: the box around the hull.
void collide_terrain(const TransformedShape& box, const CollisionGeometry& hull, const HullSupport& support,
                     const Pose& pose, const Terrain& terrain, std::vector<ContactPoint>& points, bool is_left = false);

}  // namespace muro::native
