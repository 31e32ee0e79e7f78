// SPDX-License-Identifier: MIT
#include "bullet_engine.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <btBulletCollisionCommon.h>

#include "plugins/common/engines/bullet/bullet_types.hpp"

namespace muro::bullet_collision {
namespace {

using bullet::from_bullet, bullet::to_bullet;
using contact_geometry::CollisionGeometry;
using contact_geometry::EngineContact;

std::unique_ptr<btConvexHullShape> hull_of(const mesh::Hull& hull) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : hull.vertices) shape->addPoint(to_bullet(v), false);
  shape->recalcLocalAabb();
  return shape;
}

/// Makes a Bullet shape without margins: it has its true size and sharp edges.
std::unique_ptr<btCollisionShape> shape_of(const CollisionGeometry& s, ShapeData& data) {
  const Vec3& size = s.shape.size;
  const double r = size.x();
  std::unique_ptr<btCollisionShape> shape;
  switch (s.shape.kind) {
    case ShapeKind::sphere:
      return std::make_unique<btSphereShape>(r);
    case ShapeKind::capsule:
      return std::make_unique<btCapsuleShapeZ>(r, size.z());
    case ShapeKind::plane:
      shape = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0);
      break;
    case ShapeKind::box:
      shape = std::make_unique<btBoxShape>(to_bullet(Vec3(0.5 * size)));
      break;
    case ShapeKind::cylinder:
      shape = std::make_unique<btCylinderShapeZ>(btVector3(r, r, 0.5 * size.z()));
      break;
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      if (s.hull) {
        shape = hull_of(*s.hull);
        break;
      }
      auto triangles = std::make_unique<btTriangleMesh>();
      for (const Vec3& v : s.exact_mesh->surface().vertices) triangles->findOrAddVertex(to_bullet(v), false);
      for (const mesh::Triangle& t : s.exact_mesh->surface().triangles)
        triangles->addTriangleIndices(int(t[0]), int(t[1]), int(t[2]));
      shape = std::make_unique<btBvhTriangleMeshShape>(triangles.get(), true);
      data.triangles = std::move(triangles);
      break;
  }
  shape->setMargin(0);
  return shape;
}

/// Collects the contacts that an algorithm finds, in place of a persistent manifold.
class ContactCollector final : public btManifoldResult {
 public:
  ContactCollector(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, bool is_mesh,
                   std::vector<EngineContact>& contacts)
      : btManifoldResult(&a, &b), is_mesh_(is_mesh), contacts_(contacts) {
    m_closestPointDistanceThreshold = 0;
  }
  void addContactPoint(const btVector3& normal, const btVector3& on_b, btScalar distance) override {
    contacts_.push_back({from_bullet(on_b) + 0.5 * distance * from_bullet(normal), from_bullet(normal), -distance,
                         is_mesh_ ? std::int64_t(m_index1) : -1});
  }

 private:
  bool is_mesh_;
  std::vector<EngineContact>& contacts_;
};

class BulletNarrowPhase final : public contact_geometry::NarrowPhase {
 public:
  explicit BulletNarrowPhase(const std::vector<ShapeData>& shapes)
      : shapes_(shapes), configuration_(small_pools()), dispatcher_(&configuration_) {}

  void collide(std::uint32_t a, const Pose& at_a, std::uint32_t b, const Pose& at_b,
               std::vector<EngineContact>& contacts) override {
    set(first_, shapes_[a], at_a);
    set(second_, shapes_[b], at_b);
    const btCollisionObjectWrapper object_a(nullptr, first_.getCollisionShape(), &first_, first_.getWorldTransform(),
                                            -1, -1),
        object_b(nullptr, second_.getCollisionShape(), &second_, second_.getWorldTransform(), -1, -1);
    btCollisionAlgorithm* const algorithm =
        dispatcher_.findAlgorithm(&object_a, &object_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    if (!algorithm) return;
    ContactCollector collector(object_a, object_b, shapes_[b].triangles != nullptr, contacts);
    algorithm->processCollision(&object_a, &object_b, btDispatcherInfo(), &collector);
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
  }

 private:
  /// Memory for the algorithms of one pair.
  static btDefaultCollisionConstructionInfo small_pools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = 16;
    info.m_defaultMaxCollisionAlgorithmPoolSize = 16;
    return info;
  }
  static void set(btCollisionObject& object, const ShapeData& data, const Pose& pose) {
    object.setCollisionShape(data.shape.get());
    object.setWorldTransform(to_bullet(pose));
  }

  const std::vector<ShapeData>& shapes_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btCollisionObject first_, second_;
};

}  // namespace

ShapeData::ShapeData() = default;
ShapeData::ShapeData(ShapeData&&) noexcept = default;
ShapeData::~ShapeData() = default;

void BulletEngine::add(const CollisionGeometry& geometry) {
  ShapeData data;
  data.shape = shape_of(geometry, data);
  shapes_.push_back(std::move(data));
}

std::unique_ptr<contact_geometry::NarrowPhase> BulletEngine::make_narrow_phase() const {
  return std::make_unique<BulletNarrowPhase>(shapes_);
}

}  // namespace muro::bullet_collision
