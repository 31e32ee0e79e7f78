// SPDX-License-Identifier: MIT
// ODE: a vehicle as one body; the balls under it slide on the ground as fast as wheels would roll.
#include "tests/bench/baselines/ode_world.hpp"

namespace muro::bench {

namespace {

class OneBodyVehicles final : public Team, OdeWorld {
 public:
  OneBodyVehicles(const City& city, SolverSettings settings) : OdeWorld(city, settings) {
    for (const Pose& start : city.starts()) {
      Vehicle& v = add_vehicle(start, Rover::composite());
      for (int w = 0; w < 4; ++w) {
        const Vec3 at = Rover::wheel_centre(w);
        const dGeomID ball = add_wheel(v, w);
        dGeomSetBody(ball, v.chassis);
        dGeomSetOffsetPosition(ball, at.x(), at.y(), at.z());
      }
    }
  }

  void command(int vehicle, WheelSpeeds speeds) override { vehicles_[std::size_t(vehicle)].speeds = speeds; }
  void run(int milliseconds) override { OdeWorld::run(milliseconds); }
  Pose pose(int vehicle) const override { return OdeWorld::pose(vehicle); }

 private:
  /// Moves the surface of the wheel backward, across the axle, at the speed of its rim. Wheels do not drive on walls.
  void set_wheel_surface(const Vehicle& v, int wheel, dContact& contact) const override {
    const dReal* r = dBodyGetRotation(v.chassis);
    const Vec3 axle(r[1], r[5], r[9]);
    const bool first = dGeomGetBody(contact.geom.g1) == v.chassis;
    const Vec3 normal = (first ? 1 : -1) * Vec3(contact.geom.normal[0], contact.geom.normal[1], contact.geom.normal[2]);
    const Vec3 across = axle.cross(normal);
    if (normal.z() < 0.5 || across.norm() < 0.1) return;
    const Vec3 forward = across.normalized();
    contact.surface.mode |= dContactFDir1 | dContactMotion1;
    for (int k = 0; k < 3; ++k) contact.fdir1[k] = forward[k];
    contact.surface.motion1 =
        (first ? 1 : -1) * Rover::wheel_radius * (Rover::is_left(wheel) ? v.speeds.left : v.speeds.right);
  }
};

}  // namespace

std::unique_ptr<Team> ode_one_body_vehicles(const City& city, SolverSettings settings) {
  return std::make_unique<OneBodyVehicles>(city, settings);
}

}  // namespace muro::bench
