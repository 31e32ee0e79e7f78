// SPDX-License-Identifier: MIT
#pragma once

#include "mesh.hpp"

namespace muro::mesh {

/// Returns the inertia of a homogeneous solid with this surface, which is closed and faces outward. Uses the integrals
/// over the tetrahedra from a point to its triangles (Tonon, Explicit Exact Formulas for the 3-D Tetrahedron Inertia
/// Tensor in Terms of its Vertex Coordinates, J. Mathematics and Statistics 1, 2004). `density`: kg/m^3.
Inertia solid_inertia(const Mesh& surface, double density);

}  // namespace muro::mesh
