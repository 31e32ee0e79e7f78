// SPDX-License-Identifier: MIT
// Bullet: a vehicle of five bodies; hinges with motors hold the wheels.
#include "tests/bench/baselines/bullet_world.hpp"

namespace muro::bench {

namespace {

class RigidVehicles final : public Team {
 public:
  RigidVehicles(const City& city, SolverSettings settings) : steps_(settings.steps), bullet_(city, settings) {
    btCollisionShape& box = bullet_.keep(
        std::make_unique<btBoxShape>(btVector3(0.5 * Rover::length, 0.5 * Rover::width, 0.5 * Rover::height)));
    btCollisionShape& ball = bullet_.keep(std::make_unique<btSphereShape>(Rover::wheel_radius));
    const Inertia body = Rover::chassis(), wheel = Rover::wheel();
    for (const Pose& start : city.starts()) {
      Vehicle v;
      v.chassis = &bullet_.add(box, start, body.mass, {body.ixx, body.iyy, body.izz});
      for (int w = 0; w < 4; ++w) {
        const Pose place = start * Pose{Rover::wheel_centre(w), Quat::Identity()};
        btRigidBody& round = bullet_.add(ball, place, wheel.mass, {wheel.ixx, wheel.iyy, wheel.izz});
        v.hinges[std::size_t(w)] =
            std::make_unique<btHingeConstraint>(*v.chassis, round, bullet(Rover::wheel_centre(w)), btVector3(0, 0, 0),
                                                btVector3(0, 1, 0), btVector3(0, 1, 0));
        bullet_.world.addConstraint(v.hinges[std::size_t(w)].get(), true);
      }
      vehicles_.push_back(std::move(v));
    }
  }
  ~RigidVehicles() override {
    for (const Vehicle& v : vehicles_)
      for (const auto& hinge : v.hinges) bullet_.world.removeConstraint(hinge.get());
  }

  void command(int vehicle, WheelSpeeds speeds) override {
    for (int w = 0; w < 4; ++w)
      vehicles_[std::size_t(vehicle)].hinges[std::size_t(w)]->enableAngularMotor(
          true, Rover::is_left(w) ? speeds.left : speeds.right, Rover::max_torque * bullet_.step_length());
  }
  void run(int milliseconds) override {
    for (int i = 0; i < milliseconds * steps_; ++i) bullet_.step();
  }
  Pose pose(int vehicle) const override {
    return pose_of(vehicles_[std::size_t(vehicle)].chassis->getWorldTransform());
  }

 private:
  struct Vehicle {
    btRigidBody* chassis = nullptr;
    std::array<std::unique_ptr<btHingeConstraint>, 4> hinges;
  };

  const int steps_;  ///< in a millisecond
  BulletWorld bullet_;
  std::vector<Vehicle> vehicles_;
};

}  // namespace

std::unique_ptr<Team> bullet_rigid_vehicles(const City& city, SolverSettings settings) {
  return std::make_unique<RigidVehicles>(city, settings);
}

}  // namespace muro::bench
