// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <deque>

#include "bullet_meshes.hpp"
#include "bullet_solver.hpp"

namespace muro::bullet {

/// A world made of Bullet's components: its shapes, its narrow phase, its articulated bodies and its solver.
///
/// A step depends only on the state of the robots. In each step bodies are set anew, contacts are found anew in the
/// order of pairs of shapes, and the solver begins with the impulses that the robots keep. Robots that touch each other
/// are solved together, all others alone.
class BulletWorld final : public multibody::World {
 public:
  BulletWorld(const BulletSettings& settings, std::shared_ptr<const BulletMeshes> meshes);

  void add_static_body(const multibody::ExternalBody& body) override;
  void add_kinematic_body(const multibody::ExternalBody& body, const multibody::ExternalBodyState& state) override;
  void add_robot(const multibody::RobotModel& model, multibody::RobotState& state) override;
  void complete() override;
  void advance(double dt) override;

 private:
  /// A robot or kinematic body with the colliders `first` to `first + count`.
  struct CollisionObject {
    std::uint32_t first = 0, count = 0;
    Vec3 aabb_min = Vec3::Zero(), aabb_max = Vec3::Zero();  ///< m: box around all
    bool enabled = false, dynamic = false;
    Vec3 fat_aabb_min = Vec3::Zero(), fat_aabb_max = Vec3::Constant(-1);  ///< m: box in which `nearby_scenery` is valid
    std::vector<std::uint32_t> nearby_scenery;
  };
  struct Pair {
    const Collider *a, *b;
  };
  struct Island {
    std::uint32_t robot, root;
  };

  Collider& add_collider(const multibody::BodyShape& shape, bool moves);
  void move(CollisionObject& object, const multibody::BodyState* bodies);
  void find_pairs();
  void find_scenery(CollisionObject& object);
  void add_pairs_between(const CollisionObject& a, const CollisionObject& b);
  void add_self_collision_pairs(const CollisionObject& object, const BulletRobot& robot);
  void find_contacts(double dt);
  /// Finds the cells of the contacts of two colliders: friction is spread over the touching line or face.
  static void find_cells(std::span<SolverContact> pair);
  multibody::BodyState state_of(const Collider& c) const;
  void find_islands();
  void solve(std::span<const Island> robots, double dt);
  std::span<SolverContact> contacts_of(std::uint32_t robot);
  void tell_contact(const SolverContact& contact, const Vec3& force, const Vec3& torque);
  void export_contacts(double dt);

  BulletSettings settings_;
  std::shared_ptr<const BulletMeshes> meshes_;
  std::deque<Collider> colliders_;
  std::deque<BulletRobot> robots_;
  std::vector<ImpulseCache> caches_;
  std::vector<const multibody::ExternalBodyState*> kinematic_bodies_;
  std::vector<CollisionObject> objects_;  ///< robots, then kinematic bodies
  std::vector<std::uint32_t> grounds_, order_;
  btDbvt scenery_;
  NarrowPhase narrow_phase_;
  BulletSolver solver_;
  ArticulatedBodyScratch scratch_;
  std::vector<Pair> pairs_;
  std::vector<SolverContact> contacts_;
  std::vector<std::uint32_t> first_contact_;  ///< first contact of each robot as `a`; one more entry than robots
  std::vector<Island> islands_;
  std::vector<std::uint32_t> roots_;
};

}  // namespace muro::bullet
