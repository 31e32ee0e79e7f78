// SPDX-License-Identifier: MIT
// Contacts of convex shapes with a heightmap, in closed form. For motions by engines whose own height fields do not
// support bodies as well.
#pragma once

#include <array>

#include "muro/shape.hpp"
#include "muro/toolkit/heightmap.hpp"
#include "plugins/common/mesh/hull.hpp"

namespace muro::terrain_contact {

/// A box, sphere, cylinder, capsule, or the hull of a mesh, at a pose in the world.
struct ConvexShape {
  ShapeKind kind = ShapeKind::box;
  Vec3 size = Vec3::Zero();          ///< see Shape
  const mesh::Hull* hull = nullptr;  ///< of a mesh
  Pose pose{};
};

struct TerrainContact {
  Vec3 position;   ///< m, world: half way between the two surfaces
  Vec3 normal;     ///< unit, world: the direction in which the shape is pushed
  double gap = 0;  ///< m; negative where they overlap
};

inline constexpr int max_contacts = 8;
using TerrainContacts = std::array<TerrainContact, max_contacts>;

/// Finds where a shape is within `margin` (m) of the surface or under it, however deep. All below a heightmap is solid,
/// and there is nothing beyond its rim. Corners, rims and the ends of round shapes touch triangles. Nodes and edges of
/// the surface that stand out touch shapes, and push along a normal between those of their triangles, so that a shape
/// that rolls over a plane of triangles feels no edge. Returns the number of contacts. If there are too many, keeps the
/// deepest and those that are far from each other. A pose that is not finite has none. [any thread]
int find_contacts(const Heightmap& map, const Pose& map_pose, const ConvexShape& shape, double margin,
                  TerrainContacts& contacts);

}  // namespace muro::terrain_contact
