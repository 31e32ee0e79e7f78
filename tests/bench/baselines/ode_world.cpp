// SPDX-License-Identifier: MIT
#include "tests/bench/baselines/ode_world.hpp"

namespace muro::bench {

namespace {

/// User data of a geom: the number of its vehicle and, from 1 on, of its wheel; scenery has no user data.
void* user_data(std::size_t vehicle, int wheel) {
  return reinterpret_cast<void*>((vehicle + 1) * 8 + std::size_t(wheel));
}
std::size_t vehicle_of(dGeomID geom) { return reinterpret_cast<std::size_t>(dGeomGetData(geom)) / 8 - 1; }
int wheel_of(dGeomID geom) { return int(reinterpret_cast<std::size_t>(dGeomGetData(geom)) % 8); }

}  // namespace

OdeWorld::OdeWorld(const City& city, SolverSettings settings) : steps_(settings.steps) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  world_ = dWorldCreate();
  dWorldSetGravity(world_, 0, 0, -9.81);
  dWorldSetERP(world_, 0.2);
  dWorldSetCFM(world_, 1e-6);
  dWorldSetQuickStepNumIterations(world_, settings.iterations);
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
  const dQuaternion rotation = {q.w(), q.x(), q.y(), q.z()};
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  dBodySetQuaternion(body, rotation);
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
  dGeomSetData(v.geoms[0], user_data(vehicles_.size() - 1, 0));
  return v;
}

dGeomID OdeWorld::add_wheel(Vehicle& vehicle, int wheel) {
  const dGeomID ball = dCreateSphere(vehicle.space, Rover::wheel_radius);
  dGeomSetData(ball, user_data(vehicle_of(vehicle.geoms[0]), wheel + 1));
  vehicle.geoms[wheel + 1] = ball;
  return ball;
}

void OdeWorld::run(int milliseconds) {
  for (int i = 0; i < milliseconds * steps_; ++i) step();
}

void OdeWorld::step() {
  for (const Vehicle& v : vehicles_)
    for (const dGeomID geom : v.geoms) add_contacts(geom, ground_);
  dSpaceCollide2(reinterpret_cast<dGeomID>(team_), reinterpret_cast<dGeomID>(buildings_), this, &near_callback);
  dSpaceCollide(team_, this, &near_callback);
  dWorldQuickStep(world_, 1e-3 / steps_);
  dJointGroupEmpty(contacts_);
}

Pose OdeWorld::pose(int vehicle) const {
  const dBodyID body = vehicles_[std::size_t(vehicle)].chassis;
  const dReal *p = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
  return {{p[0], p[1], p[2]}, Quat(q[0], q[1], q[2], q[3])};
}

void OdeWorld::near_callback(void* self, dGeomID a, dGeomID b) {
  if (dGeomIsSpace(a) || dGeomIsSpace(b))
    dSpaceCollide2(a, b, self, &near_callback);
  else
    static_cast<OdeWorld*>(self)->add_contacts(a, b);
}

void OdeWorld::add_contacts(dGeomID a, dGeomID b) {
  constexpr int max_contacts = 4;
  dContactGeom found[max_contacts];
  const int n = dCollide(a, b, max_contacts, found, sizeof(dContactGeom));
  for (int i = 0; i < n; ++i) {
    dContact contact{};
    contact.geom = found[i];
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = Rover::friction;
    for (const dGeomID geom : {a, b})
      if (dGeomGetData(geom) && wheel_of(geom) > 0) {
        set_wheel_surface(vehicles_[vehicle_of(geom)], wheel_of(geom) - 1, contact);
        break;
      }
    dJointAttach(dJointCreateContact(world_, contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
  }
}

}  // namespace muro::bench
