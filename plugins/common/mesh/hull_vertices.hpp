// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "muro/shape.hpp"

namespace muro::mesh {

/// Returns the vertices (m) of the convex hull of a shape of kind mesh, scaled, in the frame of the shape; of a flat
/// mesh all vertices. Empty if the file cannot be read: the algorithm that collides with it reports that. Used for what
/// a robot touches at the start (toolkit/initial_contact.hpp). [setup]
std::vector<Vec3> hull_vertices(const Connector& c, const Shape& shape);

}  // namespace muro::mesh
