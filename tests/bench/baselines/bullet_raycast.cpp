// SPDX-License-Identifier: MIT
// Bullet's raycast vehicle: one body; each wheel is a ray downwards with a spring.
#include <algorithm>

#include "tests/bench/baselines/bullet_world.hpp"

namespace muro::bench {

namespace {

constexpr double travel = 0.05;  // m, of the suspension at rest

/// Finds what wheels stand on, which is scenery alone: the ground in closed form, the rest by search.
class SceneryRaycaster final : public btVehicleRaycaster {
 public:
  SceneryRaycaster(btCollisionWorld& world, const btRigidBody& ground) : world_(world), ground_(ground) {}

  void* castRay(const btVector3& from, const btVector3& to, btVehicleRaycasterResult& result) override {
    btCollisionWorld::ClosestRayResultCallback nearest(from, to);
    nearest.m_collisionFilterMask = BulletWorld::buildings;
    if (from.z() > 0 && to.z() < 0) {
      nearest.m_closestHitFraction = from.z() / (from.z() - to.z());
      nearest.m_collisionObject = &ground_;
      nearest.m_hitNormalWorld = {0, 0, 1};
      nearest.m_hitPointWorld.setInterpolate3(from, to, nearest.m_closestHitFraction);
    }
    world_.rayTest(from, to, nearest);
    if (!nearest.hasHit()) return nullptr;
    result.m_hitPointInWorld = nearest.m_hitPointWorld;
    result.m_hitNormalInWorld = nearest.m_hitNormalWorld;
    result.m_distFraction = nearest.m_closestHitFraction;
    return const_cast<btRigidBody*>(btRigidBody::upcast(nearest.m_collisionObject));  // as the interface requires
  }

 private:
  btCollisionWorld& world_;
  const btRigidBody& ground_;
};

class RaycastVehicles final : public Team {
 public:
  RaycastVehicles(const City& city, SolverSettings settings) : steps_(settings.steps), bullet_(city, settings) {
    btCollisionShape& chassis = bullet_.keep(
        std::make_unique<btBoxShape>(btVector3(0.5 * Rover::length, 0.5 * Rover::width, 0.5 * Rover::height)));
    const Inertia whole = Rover::composite();
    for (const Pose& start : city.starts()) {
      btRigidBody& body = bullet_.add(chassis, start, Rover::mass, {whole.ixx, whole.iyy, whole.izz});
      Vehicle v{&body, std::make_unique<btRaycastVehicle>(tuning_, &body, &raycaster_), {}};
      v.wheels->setCoordinateSystem(1, 2, 0);
      for (int w = 0; w < 4; ++w) {
        const Vec3 hard_point = Rover::wheel_centre(w) + Vec3(0, 0, travel);
        btWheelInfo& wheel =
            v.wheels->addWheel(bullet(hard_point), {0, 0, -1}, {0, -1, 0}, travel, Rover::wheel_radius, tuning_, w < 2);
        // as stiff as muro's contacts: a body on four springs oscillates at 50 Hz
        wheel.m_suspensionStiffness = 0.25 * omega * omega;
        wheel.m_wheelsDampingCompression = wheel.m_wheelsDampingRelaxation = 0.5 * omega;
        wheel.m_frictionSlip = Rover::friction;
        wheel.m_rollInfluence = 1;
      }
      bullet_.world.addAction(v.wheels.get());
      vehicles_.push_back(std::move(v));
    }
  }
  ~RaycastVehicles() override {
    for (const Vehicle& v : vehicles_) bullet_.world.removeAction(v.wheels.get());
  }

  void command(int vehicle, WheelSpeeds speeds) override { vehicles_[std::size_t(vehicle)].speeds = speeds; }
  void run(int milliseconds) override {
    for (int i = 0; i < milliseconds * steps_; ++i) {
      for (const Vehicle& v : vehicles_) drive(v);
      bullet_.step();
    }
  }
  Pose pose(int vehicle) const override { return pose_of(vehicles_[std::size_t(vehicle)].body->getWorldTransform()); }

 private:
  static constexpr double omega = 2 * M_PI * 50;

  struct Vehicle {
    btRigidBody* body;
    std::unique_ptr<btRaycastVehicle> wheels;
    WheelSpeeds speeds;
  };

  /// Drives each wheel towards its speed within the limits of its drive, because the engine takes forces, not speeds.
  static void drive(const Vehicle& v) {
    const btMatrix3x3& axes = v.body->getWorldTransform().getBasis();
    const double forward = v.body->getLinearVelocity().dot(axes.getColumn(0));
    const double turning = v.body->getAngularVelocity().dot(axes.getColumn(2));
    constexpr double max_force = Rover::max_torque / Rover::wheel_radius, gain = 0.25 * Rover::mass / 5e-3;
    for (int w = 0; w < 4; ++w) {
      const double target = Rover::wheel_radius * (Rover::is_left(w) ? v.speeds.left : v.speeds.right);
      const double ground = forward - turning * Rover::wheel_centre(w).y();
      v.wheels->applyEngineForce(std::clamp(gain * (target - ground), -max_force, max_force), w);
    }
  }

  const int steps_;  ///< in a millisecond
  BulletWorld bullet_;
  SceneryRaycaster raycaster_{bullet_.world, *bullet_.ground};
  btRaycastVehicle::btVehicleTuning tuning_;
  std::vector<Vehicle> vehicles_;
};

}  // namespace

std::unique_ptr<Team> bullet_raycast_vehicles(const City& city, SolverSettings settings) {
  return std::make_unique<RaycastVehicles>(city, settings);
}

}  // namespace muro::bench
