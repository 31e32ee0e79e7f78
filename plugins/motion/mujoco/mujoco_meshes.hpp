// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "plugins/motion/common/multibody/mesh_shapes.hpp"

namespace muro::mujoco {

/// The vertices (m, in the frame of the shape) of the convex hulls of a scene's collision meshes.
using MujocoMeshes = multibody::MeshShapes<std::vector<Vec3>>;

}  // namespace muro::mujoco
