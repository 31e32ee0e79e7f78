// SPDX-License-Identifier: MIT
// Where convex shapes touch a heightmap, in closed form: for motions by engines whose own height fields do not carry
// bodies as well.
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

/// Where a shape is within `margin` (m) of the surface or under it, however deep: what is below a heightmap is solid,
/// and beyond its rim is nothing. Corners, rims and the ends of round shapes touch triangles; nodes and edges of the
/// surface that stand out touch shapes, and push along a normal between those of their triangles, so that what rolls
/// over a plane of triangles feels no edge. Returns the number of contacts: of more, the deepest and those that are
/// far from each other; none of a shape that is nowhere. [any thread]
int find_contacts(const Heightmap& map, const Pose& map_pose, const ConvexShape& shape, double margin,
                  TerrainContacts& contacts);

}  // namespace muro::terrain_contact
