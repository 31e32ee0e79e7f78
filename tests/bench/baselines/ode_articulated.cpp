// SPDX-License-Identifier: MIT
// ODE: a vehicle of five bodies; hinges with motors hold the wheels.
#include "tests/bench/baselines/ode_world.hpp"

namespace muro::bench {

namespace {

class ArticulatedVehicles final : public Team, OdeWorld {
 public:
  ArticulatedVehicles(const City& city, SolverSettings settings) : OdeWorld(city, settings) {
    for (const Pose& start : city.starts()) {
      Vehicle& v = add_vehicle(start, Rover::chassis());
      for (int w = 0; w < 4; ++w) {
        const Pose place = start * Pose{Rover::wheel_centre(w), Quat::Identity()};
        const Vec3 axle = start.orientation * Vec3::UnitY();
        const dBodyID body = add_body(world_, place, Rover::wheel());
        dBodySetFiniteRotationMode(body, 0);
        dGeomSetBody(add_wheel(v, w), body);
        const dJointID hinge = dJointCreateHinge(world_, nullptr);
        dJointAttach(hinge, body, v.chassis);
        dJointSetHingeAnchor(hinge, place.position.x(), place.position.y(), place.position.z());
        dJointSetHingeAxis(hinge, axle.x(), axle.y(), axle.z());
        dJointSetHingeParam(hinge, dParamFMax, Rover::max_torque);
        hinges_.push_back(hinge);
      }
    }
  }

  void command(int vehicle, WheelSpeeds speeds) override {
    for (int w = 0; w < 4; ++w)
      dJointSetHingeParam(hinges_[std::size_t(4 * vehicle + w)], dParamVel,
                          Rover::is_left(w) ? speeds.left : speeds.right);
  }
  void run(int milliseconds) override { OdeWorld::run(milliseconds); }
  Pose pose(int vehicle) const override { return OdeWorld::pose(vehicle); }

 private:
  void set_wheel_surface(const Vehicle&, int, dContact&) const override {}  // wheels are bodies that roll

  std::vector<dJointID> hinges_;
};

}  // namespace

std::unique_ptr<Team> ode_articulated_vehicles(const City& city, SolverSettings settings) {
  return std::make_unique<ArticulatedVehicles>(city, settings);
}

}  // namespace muro::bench
