// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "terrain/sides.hpp"

namespace muro::native {

/// An edge between two triangles of a heightmap, or on the rim. Seen along it the triangle with `left` lies to the
/// left.
struct Edge {
  Vec3 from, to;  ///< m
  const Side &left, &right;
};

/// Adds the contact of a solid with a convex edge of a heightmap, whose normal lies between those of the triangles
/// beside it: where that part of the solid which is lowest along the normal lies just over the edge. Nothing where the
/// solid is over one of the triangles, or above. In the frame of the heightmap.
void add_edge_contacts(const Solid& solid, const Edge& edge, std::vector<ContactPoint>& points);

/// The same of a peak: a node in the solid, with the shortest way out through a side of the solid whose normal leaves
/// all that is around the node below.
void add_peak_contact(const Solid& solid, const Terrain& terrain, std::uint32_t column, std::uint32_t row,
                      std::vector<ContactPoint>& points);

/// Whether a box in the axes of the solid around both tells that the solid and a line are apart.
bool is_apart(const Solid& solid, const Vec3& from, const Vec3& to);

}  // namespace muro::native
