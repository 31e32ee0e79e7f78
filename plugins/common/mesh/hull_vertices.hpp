// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "muro/shape.hpp"

namespace muro::mesh {

/// The vertices (m) of the convex hull of a shape of kind mesh, scaled, in the frame of the shape; those of a flat mesh
/// as they are. Empty where the file cannot be read: who collides with it reports that. For what a robot touches at the
/// start (toolkit/initial_contact.hpp). [setup]
std::vector<Vec3> hull_vertices(const Connector& c, const Shape& shape);

}  // namespace muro::mesh
