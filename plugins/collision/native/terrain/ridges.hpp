// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "terrain/sides.hpp"

namespace muro::native {

/// An edge between two triangles of a heightmap, or on the rim. Seen along the edge, the triangle with `left` lies to
/// the left.
struct Edge {
  Vec3 from, to;  ///< m
  const Side &left, &right;
};

/// Adds the contact of a solid with a convex edge of a heightmap, in the frame of the heightmap. The normal lies
/// between those of the triangles beside the edge, and is chosen such that the lowest part of the solid along it lies
/// just over the edge. Adds nothing if the solid is over one of the triangles, or above the surface.
void add_edge_contacts(const Solid& solid, const Edge& edge, std::vector<ContactPoint>& points);

/// Adds the contact of a solid with a peak, which is a node in the solid. It takes the shortest way out through a side
/// of the solid whose normal leaves all of the surface around the node below.
void add_peak_contact(const Solid& solid, const Terrain& terrain, std::uint32_t column, std::uint32_t row,
                      std::vector<ContactPoint>& points);

/// Whether a solid and a line are apart, found by boxes around both in the axes of the solid.
bool is_apart(const Solid& solid, const Vec3& from, const Vec3& to);

}  // namespace muro::native
