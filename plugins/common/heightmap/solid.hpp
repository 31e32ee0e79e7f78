// SPDX-License-Identifier: MIT
// The solid under a heightmap, for those that see it from outside: rays and pictures.
#pragma once

#include "muro/toolkit/heightmap.hpp"
#include "plugins/common/mesh/mesh.hpp"

namespace muro::heightmap {

/// Whether a point (m, in the frame of the shape) is on or under the surface, however deep.
bool contains(const Heightmap& heightmap, const Vec3& point);

/// Returns the solid down to its lowest height as a closed mesh: the surface (as mesh_of()), walls below its rim, a
/// floor.
mesh::Mesh solid_mesh_of(const Heightmap& heightmap);

/// Returns the nodes on the rim, counter-clockwise seen from above, beginning with the corner at -x -y, without
/// repeating it.
std::vector<Heightmap::Cell> rim_of(const Heightmap& heightmap);

}  // namespace muro::heightmap
