// SPDX-License-Identifier: MIT
#include "bullet_engine.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <btBulletCollisionCommon.h>

namespace muro::bullet_collision {
namespace {

using encounters::Solid;
using encounters::Touch;

btVector3 vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btTransform transform_of(const Pose& p) {
  const Quat& q = p.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), vector(p.position));
}

std::unique_ptr<btConvexHullShape> hull_of(const mesh::Hull& hull) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : hull.vertices) shape->addPoint(vector(v), false);
  shape->recalcLocalAabb();
  return shape;
}

/// Without margins: shapes have their true size and sharp edges.
std::unique_ptr<btCollisionShape> shape_of(const Solid& s, Form& form) {
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
      shape = std::make_unique<btBoxShape>(vector(Vec3(0.5 * size)));
      break;
    case ShapeKind::cylinder:
      shape = std::make_unique<btCylinderShapeZ>(btVector3(r, r, 0.5 * size.z()));
      break;
    case ShapeKind::mesh:
      if (s.hull) {
        shape = hull_of(*s.hull);
        break;
      }
      auto triangles = std::make_unique<btTriangleMesh>();
      for (const Vec3& v : s.terrain->surface().vertices) triangles->findOrAddVertex(vector(v), false);
      for (const mesh::Triangle& t : s.terrain->surface().triangles)
        triangles->addTriangleIndices(int(t[0]), int(t[1]), int(t[2]));
      shape = std::make_unique<btBvhTriangleMeshShape>(triangles.get(), true);
      form.triangles = std::move(triangles);
      break;
  }
  shape->setMargin(0);
  return shape;
}

/// Takes what an algorithm finds instead of a manifold.
class Taker final : public btManifoldResult {
 public:
  Taker(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, bool is_mesh, std::vector<Touch>& touches)
      : btManifoldResult(&a, &b), is_mesh_(is_mesh), touches_(touches) {
    m_closestPointDistanceThreshold = 0;
  }
  void addContactPoint(const btVector3& normal, const btVector3& on_b, btScalar distance) override {
    touches_.push_back({vector(on_b) + 0.5 * distance * vector(normal), vector(normal), -distance,
                        is_mesh_ ? std::int64_t(m_index1) : -1});
  }

 private:
  bool is_mesh_;
  std::vector<Touch>& touches_;
};

class BulletNarrowphase final : public encounters::Narrowphase {
 public:
  explicit BulletNarrowphase(const std::vector<Form>& forms)
      : forms_(forms), configuration_(few()), dispatcher_(&configuration_) {}

  void touch(std::uint32_t a, const Pose& at_a, std::uint32_t b, const Pose& at_b,
             std::vector<Touch>& touches) override {
    place(first_, forms_[a], at_a);
    place(second_, forms_[b], at_b);
    const btCollisionObjectWrapper on(nullptr, first_.getCollisionShape(), &first_, first_.getWorldTransform(), -1, -1),
        below(nullptr, second_.getCollisionShape(), &second_, second_.getWorldTransform(), -1, -1);
    btCollisionAlgorithm* const algorithm =
        dispatcher_.findAlgorithm(&on, &below, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    if (!algorithm) return;
    Taker taker(on, below, forms_[b].triangles != nullptr, touches);
    algorithm->processCollision(&on, &below, btDispatcherInfo(), &taker);
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
  }

 private:
  /// Pools for the algorithms of one pair.
  static btDefaultCollisionConstructionInfo few() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = 16;
    info.m_defaultMaxCollisionAlgorithmPoolSize = 16;
    return info;
  }
  static void place(btCollisionObject& object, const Form& form, const Pose& pose) {
    object.setCollisionShape(form.shape.get());
    object.setWorldTransform(transform_of(pose));
  }

  const std::vector<Form>& forms_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btCollisionObject first_, second_;
};

}  // namespace

Form::Form() = default;
Form::Form(Form&&) noexcept = default;
Form::~Form() = default;

void BulletEngine::add(const Solid& solid) {
  Form form;
  form.shape = shape_of(solid, form);
  forms_.push_back(std::move(form));
}

std::unique_ptr<encounters::Narrowphase> BulletEngine::narrowphase() const {
  return std::make_unique<BulletNarrowphase>(forms_);
}

}  // namespace muro::bullet_collision
