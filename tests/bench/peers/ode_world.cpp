// SPDX-License-Identifier: MIT
#include "tests/bench/peers/ode_world.hpp"

namespace muro::bench {

namespace {

/// What a geom is: the vehicle's number and, from 1 on, its wheel; scenery has nothing.
void* mark(std::size_t vehicle, int part) { return reinterpret_cast<void*>((vehicle + 1) * 8 + std::size_t(part)); }
std::size_t vehicle_of(dGeomID geom) { return reinterpret_cast<std::size_t>(dGeomGetData(geom)) / 8 - 1; }
int part_of(dGeomID geom) { return int(reinterpret_cast<std::size_t>(dGeomGetData(geom)) % 8); }

}  // namespace

OdeWorld::OdeWorld(const City& city, Effort effort) : steps_(effort.steps) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  world_ = dWorldCreate();
  dWorldSetGravity(world_, 0, 0, -9.81);
  dWorldSetERP(world_, 0.2);
  dWorldSetCFM(world_, 1e-6);
  dWorldSetQuickStepNumIterations(world_, effort.iterations);
  dWorldSetAutoDisableFlag(world_, 0);
  contacts_ = dJointGroupCreate(0);
  buildings_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  team_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  ground_ = dCreatePlane(nullptr, 0, 0, 1, 0);
  for (const Block& b : city.blocks()) {
    const dGeomID box = dCreateBox(buildings_, b.lengths.x(), b.lengths.y(), b.lengths.z());
    dGeomSetPosition(box, b.centre.x(), b.centre.y(), b.centre.z());
  }
  vehicles_.reserve(city.starts().size());
}

OdeWorld::~OdeWorld() {
  dJointGroupDestroy(contacts_);
  dGeomDestroy(ground_);
  dSpaceDestroy(buildings_);
  dSpaceDestroy(team_);
  dWorldDestroy(world_);
  dCloseODE();
}

dBodyID OdeWorld::add_body(dWorldID world, const Pose& pose, const Inertia& inertia) {
  const dBodyID body = dBodyCreate(world);
  const Quat& q = pose.orientation;
  const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  dBodySetQuaternion(body, turn);
  dMass mass;
  dMassSetParameters(&mass, inertia.mass, 0, 0, 0, inertia.ixx, inertia.iyy, inertia.izz, 0, 0, 0);
  dBodySetMass(body, &mass);
  return body;
}

OdeWorld::Vehicle& OdeWorld::add_vehicle(const Pose& start, const Inertia& inertia) {
  Vehicle& v = vehicles_.emplace_back();
  v.space = dSimpleSpaceCreate(team_);
  dSpaceSetSublevel(v.space, 1);
  v.chassis = add_body(world_, start, inertia);
  v.geoms[0] = dCreateBox(v.space, Rover::length, Rover::width, Rover::height);
  dGeomSetBody(v.geoms[0], v.chassis);
  dGeomSetData(v.geoms[0], mark(vehicles_.size() - 1, 0));
  return v;
}

dGeomID OdeWorld::add_wheel(Vehicle& vehicle, int wheel) {
  const dGeomID ball = dCreateSphere(vehicle.space, Rover::wheel_radius);
  dGeomSetData(ball, mark(vehicle_of(vehicle.geoms[0]), wheel + 1));
  vehicle.geoms[wheel + 1] = ball;
  return ball;
}

void OdeWorld::run(int milliseconds) {
  for (int i = 0; i < milliseconds * steps_; ++i) step();
}

void OdeWorld::step() {
  for (const Vehicle& v : vehicles_)
    for (const dGeomID geom : v.geoms) touch(geom, ground_);
  dSpaceCollide2(reinterpret_cast<dGeomID>(team_), reinterpret_cast<dGeomID>(buildings_), this, &meet);
  dSpaceCollide(team_, this, &meet);
  dWorldQuickStep(world_, 1e-3 / steps_);
  dJointGroupEmpty(contacts_);
}

Pose OdeWorld::pose(int vehicle) const {
  const dBodyID body = vehicles_[std::size_t(vehicle)].chassis;
  const dReal *p = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
  return {{p[0], p[1], p[2]}, Quat(q[0], q[1], q[2], q[3])};
}

void OdeWorld::meet(void* self, dGeomID a, dGeomID b) {
  if (dGeomIsSpace(a) || dGeomIsSpace(b))
    dSpaceCollide2(a, b, self, &meet);
  else
    static_cast<OdeWorld*>(self)->touch(a, b);
}

void OdeWorld::touch(dGeomID a, dGeomID b) {
  constexpr int most = 4;
  dContactGeom found[most];
  const int n = dCollide(a, b, most, found, sizeof(dContactGeom));
  for (int i = 0; i < n; ++i) {
    dContact contact{};
    contact.geom = found[i];
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = Rover::friction;
    for (const dGeomID geom : {a, b})
      if (dGeomGetData(geom) && part_of(geom) > 0) {
        surface_of_wheel(vehicles_[vehicle_of(geom)], part_of(geom) - 1, contact);
        break;
      }
    dJointAttach(dJointCreateContact(world_, contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
  }
}

}  // namespace muro::bench
