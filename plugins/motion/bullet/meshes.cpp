// SPDX-License-Identifier: MIT
#include "meshes.hpp"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <string>

#include "convert.hpp"
#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::bullet {

namespace {

constexpr double hull_margin = 5e-4;  ///< m

std::shared_ptr<btCollisionShape> hull_shape(const mesh::Hull& hull) {
  auto shape = std::make_shared<btConvexHullShape>();
  for (const Vec3& v : hull.vertices) shape->addPoint(bullet(v), false);
  shape->setMargin(hull_margin);
  shape->recalcLocalAabb();
  shape->initializePolyhedralFeatures();
  return shape;
}

}  // namespace

Meshes::Key Meshes::key_of(const Shape& s) {
  return {static_cast<std::uint32_t>(s.mesh), s.size.x(), s.size.y(), s.size.z()};
}

void Meshes::load(const Connector& c, bool exact) {
  mesh::Store store;
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    const bool as_it_is = exact && c.robot_of(object) < 0;
    for (const Shape& s : c.constant_array(object, keys::collision_shapes)) {
      if (s.kind != ShapeKind::mesh) continue;
      auto& shape = (as_it_is ? exact_ : hulls_)[key_of(s)];
      if (shape) continue;
      const std::string path(c.text(s.mesh));
      if (!as_it_is) {
        shape = hull_shape(store.hull(path, s.size));
        continue;
      }
      const mesh::Mesh& mesh = store.mesh(path, s.size);
      auto t = std::make_shared<Triangles>();
      for (const Vec3& v : mesh.vertices) t->vertices.insert(t->vertices.end(), {v.x(), v.y(), v.z()});
      for (const mesh::Triangle& corners : mesh.triangles)
        for (const std::uint32_t corner : corners) t->corners.push_back(int(corner));
      t->view = std::make_unique<btTriangleIndexVertexArray>(int(mesh.triangles.size()), t->corners.data(),
                                                             int(3 * sizeof(int)), int(mesh.vertices.size()),
                                                             t->vertices.data(), int(3 * sizeof(double)));
      t->shape = std::make_unique<btBvhTriangleMeshShape>(t->view.get(), true);
      t->shape->setMargin(0);
      shape = std::shared_ptr<btCollisionShape>(t, t->shape.get());
    }
  }
}

std::shared_ptr<btCollisionShape> Meshes::hull(const Shape& shape) const {
  const auto found = hulls_.find(key_of(shape));
  return found == hulls_.end() ? nullptr : found->second;
}

std::shared_ptr<btCollisionShape> Meshes::scenery(const Shape& shape) const {
  const auto found = exact_.find(key_of(shape));
  return found == exact_.end() ? hull(shape) : found->second;
}

}  // namespace muro::bullet
