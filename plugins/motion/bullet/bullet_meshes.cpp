// SPDX-License-Identifier: MIT
#include "bullet_meshes.hpp"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include "plugins/common/engines/bullet/bullet_types.hpp"

namespace muro::bullet {

namespace {

constexpr double hull_margin = 5e-4;  ///< m

/// A triangle mesh of Bullet with the arrays that it points into.
struct TriangleMesh {
  std::vector<double> vertices;
  std::vector<int> corners;
  std::unique_ptr<btTriangleIndexVertexArray> view;
  std::unique_ptr<btCollisionShape> shape;
};

}  // namespace

std::shared_ptr<btCollisionShape> convex_hull_shape(const mesh::Hull& hull) {
  auto shape = std::make_shared<btConvexHullShape>();
  for (const Vec3& v : hull.vertices) shape->addPoint(to_bullet(v), false);
  shape->setMargin(hull_margin);
  shape->recalcLocalAabb();
  shape->initializePolyhedralFeatures();
  return shape;
}

std::shared_ptr<btCollisionShape> triangle_mesh_shape(const mesh::Mesh& mesh) {
  auto t = std::make_shared<TriangleMesh>();
  for (const Vec3& v : mesh.vertices) t->vertices.insert(t->vertices.end(), {v.x(), v.y(), v.z()});
  for (const mesh::Triangle& corners : mesh.triangles)
    for (const std::uint32_t corner : corners) t->corners.push_back(int(corner));
  t->view = std::make_unique<btTriangleIndexVertexArray>(int(mesh.triangles.size()), t->corners.data(),
                                                         int(3 * sizeof(int)), int(mesh.vertices.size()),
                                                         t->vertices.data(), int(3 * sizeof(double)));
  t->shape = std::make_unique<btBvhTriangleMeshShape>(t->view.get(), true);
  t->shape->setMargin(0);
  return {t, t->shape.get()};
}

}  // namespace muro::bullet
