// SPDX-License-Identifier: MIT
#pragma once

#include "muro/key.hpp"

namespace muro::keys {

/// Array, constant of the body of a model that was read from a mesh file: the corners of the mesh's convex hull in the
/// frame of the file. Hosts ask for it to place what has meshes.
inline constexpr Key<Vec3> mesh_corners{"mesh.corners", "m", "corners of the convex hull of a mesh, in its own frame"};

}  // namespace muro::keys
