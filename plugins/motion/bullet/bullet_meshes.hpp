// SPDX-License-Identifier: MIT
// Shapes of Bullet made from mesh files.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <memory>

#include "plugins/motion/common/multibody/mesh_shapes.hpp"

namespace muro::bullet {

using BulletMeshes = multibody::MeshShapes<std::shared_ptr<btCollisionShape>>;

std::shared_ptr<btCollisionShape> convex_hull_shape(const mesh::Hull& hull);
/// Returns a shape of the triangles themselves, for bodies that do not move.
std::shared_ptr<btCollisionShape> triangle_mesh_shape(const mesh::Mesh& mesh);

}  // namespace muro::bullet
