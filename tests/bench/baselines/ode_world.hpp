// SPDX-License-Identifier: MIT
// Code that both ODE programs share: a world with fast settings, with the city in it.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "tests/bench/baselines/team.hpp"

namespace muro::bench {

/// Every vehicle is a space of its own: a chassis (geom 0) and the balls of its wheels (1 to 4). The ground is tested
/// without search; vehicles find buildings and each other by sweep and prune.
class OdeWorld {
 public:
  OdeWorld(const City& city, SolverSettings settings);
  virtual ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  void run(int milliseconds);
  Pose pose(int vehicle) const;

 protected:
  struct Vehicle {
    dSpaceID space = nullptr;
    dBodyID chassis = nullptr;
    dGeomID geoms[5] = {};
    WheelSpeeds speeds;
  };
  /// Adds a vehicle whose chassis collides; the caller adds the wheels.
  Vehicle& add_vehicle(const Pose& start, const Inertia& inertia);
  dGeomID add_wheel(Vehicle& vehicle, int wheel);
  static dBodyID add_body(dWorldID world, const Pose& pose, const Inertia& inertia);
  /// Completes the contact of a wheel's ball.
  virtual void set_wheel_surface(const Vehicle& vehicle, int wheel, dContact& contact) const = 0;

  dWorldID world_ = nullptr;
  std::vector<Vehicle> vehicles_;

 private:
  void step();
  static void near_callback(void* self, dGeomID a, dGeomID b);
  void add_contacts(dGeomID a, dGeomID b);

  const int steps_;  ///< in a millisecond
  dSpaceID buildings_ = nullptr, team_ = nullptr;
  dGeomID ground_ = nullptr;
  dJointGroupID contacts_ = nullptr;
};

}  // namespace muro::bench
