// SPDX-License-Identifier: MIT
// The points in which two shapes touch.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>

#include "collider.hpp"

namespace muro::bullet {

struct ContactPoint {
  Vec3 position;   ///< m, world: halfway between the two surfaces
  Vec3 normal;     ///< unit, world: direction in which the first shape is pushed
  double gap = 0;  ///< m; negative where they overlap
};

/// Bullet's algorithms for pairs of shapes, run anew each time: nothing is kept from step to step.
class NarrowPhase {
 public:
  static constexpr int max_points = 8;    ///< points of a pair
  static constexpr double margin = 0.02;  ///< m: surfaces farther apart are not in contact

  NarrowPhase();
  /// Finds the points in which `a` is within `margin` of `b`, and returns their number. Neither shape moves; `a` is no
  /// plane.
  int find(const Collider& a, const Collider& b, ContactPoint* out);

 private:
  /// Runs Bullet's algorithm for the pair. `perturbations`: number of directions in which the smaller shape is turned a
  /// little to find more points.
  int collide(const Collider& a, const Collider& b, int perturbations, ContactPoint* out);
  static int read(const btPersistentManifold& manifold, double sign, ContactPoint* out);

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDispatcherInfo info_;
  btGjkEpaPenetrationDepthSolver depth_solver_;
  btCollisionObject first_, second_;  ///< represent the bodies: Bullet must distinguish them
  btPersistentManifold manifold_;
  btManifoldArray manifolds_;
};

}  // namespace muro::bullet
