// SPDX-License-Identifier: MIT
// Code that both Bullet programs share: a world with fast settings, with the city in it.
#pragma once

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <vector>

#include "tests/bench/baselines/team.hpp"

namespace muro::bench {

inline btVector3 bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion bullet(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline Pose pose_of(const btTransform& t) {
  const btVector3& p = t.getOrigin();
  const btQuaternion q = t.getRotation();
  return {{p.x(), p.y(), p.z()}, Quat(q.w(), q.x(), q.y(), q.z())};
}
inline btTransform bullet(const Pose& p) { return btTransform(bullet(p.orientation), bullet(p.position)); }

class BulletWorld {
 public:
  BulletWorld(const City& city, SolverSettings settings) : step_(1e-3 / settings.steps) {
    world.setGravity({0, 0, -9.81});
    world.setForceUpdateAllAabbs(false);  // buildings do not move
    world.getSolverInfo().m_numIterations = settings.iterations;
    world.getSimulationIslandManager()->setSplitIslands(false);  // the sorting of islands is quadratic

    ground = &add(keep(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0)), {}, 0);
    for (const Block& b : city.blocks()) {
      btRigidBody& box =
          add(keep(std::make_unique<btBoxShape>(bullet(0.5 * b.lengths))), {b.centre, Quat::Identity()}, 0);
      box.getBroadphaseProxy()->m_collisionFilterGroup |= buildings;
    }
    broadphase_.optimize();
  }
  ~BulletWorld() {
    for (const auto& body : bodies_) world.removeRigidBody(body.get());
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  btCollisionShape& keep(std::unique_ptr<btCollisionShape> shape) {
    shapes_.push_back(std::move(shape));
    return *shapes_.back();
  }
  btRigidBody& add(btCollisionShape& shape, const Pose& pose, double mass, const Vec3& inertia = Vec3::Zero()) {
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, bullet(inertia));
    info.m_startWorldTransform = bullet(pose);
    info.m_friction = std::sqrt(Rover::friction);  // a pair has the product
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }
  double step_length() const { return step_; }  ///< s
  void step() { world.stepSimulation(step_, 0); }

 private:
  double step_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;

 public:
  static constexpr int buildings = 64;  ///< a collision filter group beside Bullet's own
  const btRigidBody* ground = nullptr;
  btDiscreteDynamicsWorld world{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

}  // namespace muro::bench
