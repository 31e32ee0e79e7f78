// SPDX-License-Identifier: MIT
#include "ode_world.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "muro/algorithm.hpp"

namespace muro::ode {

using multibody::MotionType;

namespace {

/// ODE has one random number generator per process, so its worlds make their steps one after the other.
std::mutex& step_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Keeps objects that ODE cannot destroy after an error has left them half done.
void abandon(std::vector<void*> parts) {
  static std::mutex mutex;
  static auto& abandoned = *new std::vector<std::vector<void*>>;
  const std::lock_guard lock(mutex);
  abandoned.push_back(std::move(parts));
}

constexpr int max_contacts = 8;  ///< per pair of geoms

}  // namespace

OdeWorld::OdeWorld(const OdeSettings& settings, std::shared_ptr<const OdeMeshes> meshes,
                   std::shared_ptr<MessageLog> messages)
    : settings_(settings), meshes_(std::move(meshes)), messages_(std::move(messages)) {
  start_library();
  prepare_this_thread();
  world_ = dWorldCreate();
  // The world has its own threading, because a failure leaves a step half done.
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_), threading_);
  dWorldSetGravity(world_, settings.gravity.x(), settings.gravity.y(), settings.gravity.z());
  dWorldSetERP(world_, settings.erp);
  dWorldSetQuickStepNumIterations(world_, settings.iterations);
  dWorldSetContactMaxCorrectingVel(world_, settings.correcting_speed);
  dWorldSetAutoDisableFlag(world_, 0);
  contact_joints_ = dJointGroupCreate(0);
  static_space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  kinematic_space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  robot_space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
}

OdeWorld::~OdeWorld() {
  if (has_failed_) {
    abandon({world_, contact_joints_, threading_, static_space_, kinematic_space_, robot_space_});
    return;
  }
  dJointGroupDestroy(contact_joints_);
  for (const dGeomID ground : grounds_) dGeomDestroy(ground);
  dSpaceDestroy(robot_space_);
  dSpaceDestroy(kinematic_space_);
  dSpaceDestroy(static_space_);
  dWorldDestroy(world_);
  dThreadingFreeImplementation(threading_);
}

template <class Work>
void OdeWorld::guarded(const Work& work) {
  const ErrorTrap trap(*messages_);
  try {
    work();
  } catch (...) {
    has_failed_ = true;
    throw;
  }
}

GeomOwner& OdeWorld::set_owner(dGeomID geom, const multibody::BodyShape& shape) {
  owners_.push_back({std::uint32_t(owners_.size()), -1, 0, shape.loaded_link, shape.shape.surface,
                     contact_geometry::extent_of(shape.shape)});
  owners_.back().object = shape.object;
  dGeomSetData(geom, &owners_.back());
  return owners_.back();
}

void OdeWorld::add_static_body(const multibody::ExternalBody& body) {
  guarded([&] {
    for (const multibody::BodyShape& s : body.shapes) {
      const bool is_terrain = s.shape.kind == ShapeKind::heightmap;
      const bool is_ground = is_terrain || s.shape.kind == ShapeKind::plane;
      const Pose pose = body.pose * s.shape.origin;
      const dGeomID geom = create_geom(s.shape, pose, nullptr, is_ground ? nullptr : static_space_, *meshes_);
      if (!geom) continue;
      GeomOwner& owner = set_owner(geom, s);
      if (s.shape.kind != ShapeKind::mesh) owner.scenery = &body.name;
      if (is_ground) grounds_.push_back(geom);
      if (!is_terrain) continue;
      owner.is_terrain = true;
      owner.heightmap = meshes_->heightmap(s.shape);
      owner.pose = pose;
    }
  });
}

void OdeWorld::add_kinematic_body(const multibody::ExternalBody& body, const multibody::ExternalBodyState& state) {
  KinematicBody& k = kinematic_bodies_.emplace_back();
  k.state = &state;
  guarded([&] {
    k.body = dBodyCreate(world_);
    dBodySetKinematic(k.body);
    for (const multibody::BodyShape& s : body.shapes)
      if (const dGeomID geom = create_geom(s.shape, s.shape.origin, k.body, kinematic_space_, *meshes_)) {
        set_owner(geom, s);
        k.geoms.push_back(geom);
      }
  });
}

void OdeWorld::add_robot(const multibody::RobotModel& model, multibody::RobotState& state) {
  guarded([&] {
    const dSpaceID space = dSimpleSpaceCreate(robot_space_);
    dSpaceSetSublevel(space, 1);
    robots_.emplace_back(world_, space, model, state, std::int32_t(robots_.size()), owners_, *meshes_, settings_);
  });
}

void OdeWorld::complete() {
  pairs_.reserve(64);
  found_contacts_.resize(64);
  split_step_.resize(robots_);
}

void OdeWorld::import(KinematicBody& k) const {
  const bool enabled = k.state->motion_type == MotionType::kinematic;
  if (enabled != k.enabled) {
    k.enabled = enabled;
    for (const dGeomID geom : k.geoms) enabled ? dGeomEnable(geom) : dGeomDisable(geom);
    enabled ? dBodyEnable(k.body) : dBodyDisable(k.body);
  }
  if (!enabled) return;
  const Vec3& p = k.state->pose.position;
  const Quat& q = k.state->pose.orientation;
  const Vec3 &v = k.state->twist.linear, &w = k.state->twist.angular;
  dQuaternion orientation;
  copy_quaternion(orientation, q);
  dBodySetPosition(k.body, p.x(), p.y(), p.z());
  dBodySetQuaternion(k.body, orientation);
  dBodySetLinearVel(k.body, v.x(), v.y(), v.z());
  dBodySetAngularVel(k.body, w.x(), w.y(), w.z());
}

void OdeWorld::advance(double dt) {
  prepare_this_thread();
  guarded([&] {
    if (dt != dt_) set_step(dt);
    for (KinematicBody& k : kinematic_bodies_) import(k);
    for (OdeRobot& r : robots_) r.import();
    find_pairs();
    find_contacts();
    describe_contacts();
    for (std::size_t i = 0; i < contact_count_; ++i) create_contact_joint(found_contacts_[i]);
    const bool splits = std::any_of(found_contacts_.begin(), found_contacts_.begin() + std::ptrdiff_t(contact_count_),
                                    [](const FoundContact& c) { return c.splits; });
    if (splits) split_step_.keep_start(robots_);
    step_world(dt);
    if (splits && split_step_.find_pushed(robots_, std::span(found_contacts_).first(contact_count_))) step_again(dt);
    for (OdeRobot& r : robots_) r.export_state(dt);
    export_contacts();
    dJointGroupEmpty(contact_joints_);
  });
}

/// Sets the length of the steps. Rows without a softness of their own, which hold joints together, get that of the
/// heaviest body.
void OdeWorld::set_step(double dt) {
  dt_ = dt;
  double heaviest = 0;
  for (const OdeRobot& r : robots_)
    for (const multibody::RigidBody& b : r.model().bodies) heaviest = std::max(heaviest, b.inertia.mass);
  dWorldSetCFM(world_, settings_.cfm + (heaviest > 0 ? settings_.softness * dt / heaviest : 0));
  for (OdeRobot& r : robots_) r.set_step(dt);
}

/// Makes the second pass of a SplitStep: bodies get the positions of the step with overlap correction and the
/// velocities of the step without it.
void OdeWorld::step_again(double dt) {
  dJointGroupEmpty(contact_joints_);
  split_step_.begin_again(robots_);
  for (KinematicBody& k : kinematic_bodies_) import(k);
  for (std::size_t i = 0; i < contact_count_; ++i) {
    FoundContact& c = found_contacts_[i];
    if (!split_step_.is_pushed(c)) continue;
    if (c.splits) leave_overlap(c);
    create_contact_joint(c);
  }
  step_world(dt);
  split_step_.end(robots_);
}

void OdeWorld::step_world(double dt) {
  const std::lock_guard lock(step_mutex());
  dRandSetSeed(1);
  const int succeeded = settings_.exact ? dWorldStep(world_, dt) : dWorldQuickStep(world_, dt);
  if (!succeeded) throw Error("ODE has no memory for a step");
}

/// Finds pairs of geoms whose boxes overlap. At least one geom of a pair belongs to a robot that the world moves.
void OdeWorld::find_pairs() {
  pairs_.clear();
  for (const OdeRobot& r : robots_) {
    if (r.motion_type() != MotionType::dynamic) continue;
    for (const dGeomID geom : r.geoms())
      for (const dGeomID ground : grounds_) add_pair(geom, ground);
    if (r.model().self_collision) dSpaceCollide(r.space(), this, &near_callback);
  }
  dSpaceCollide2(reinterpret_cast<dGeomID>(robot_space_), reinterpret_cast<dGeomID>(static_space_), this,
                 &near_callback);
  dSpaceCollide2(reinterpret_cast<dGeomID>(robot_space_), reinterpret_cast<dGeomID>(kinematic_space_), this,
                 &near_callback);
  dSpaceCollide(robot_space_, this, &near_callback);
  const auto before = [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; };
  if (!std::is_sorted(pairs_.begin(), pairs_.end(), before)) std::sort(pairs_.begin(), pairs_.end(), before);
}

void OdeWorld::near_callback(void* self, dGeomID a, dGeomID b) {
  if (dGeomIsSpace(a) || dGeomIsSpace(b))
    dSpaceCollide2(a, b, self, &near_callback);
  else
    static_cast<OdeWorld*>(self)->add_pair(a, b);
}

/// Adds a pair of enabled geoms. ODE does not check whether geoms of two spaces are enabled.
void OdeWorld::add_pair(dGeomID a, dGeomID b) {
  if (!dGeomIsEnabled(a) || !dGeomIsEnabled(b)) return;
  const GeomOwner *first = &owner_of(a), *second = &owner_of(b);
  if (first->robot < 0 || (second->robot >= 0 && second->number < first->number)) {
    std::swap(first, second);
    std::swap(a, b);
  }
  if (may_collide(*first, *second)) pairs_.push_back({a, b, first->number, second->number});
}

/// Whether two geoms may collide. `a` belongs to a robot.
bool OdeWorld::may_collide(const GeomOwner& a, const GeomOwner& b) const {
  const OdeRobot& robot = robots_[std::size_t(a.robot)];
  if (b.robot == a.robot)
    return robot.model().self_collision && a.body != b.body && !robot.model().adjacent(a.body, b.body);
  return robot.motion_type() == MotionType::dynamic ||
         (b.robot >= 0 && robots_[std::size_t(b.robot)].motion_type() == MotionType::dynamic);
}

int OdeWorld::collide(const Pair& pair, FoundContact* found) {
  if (owner_of(pair.second).is_terrain) return collide_with_terrain(pair, found);
  return dCollide(pair.first, pair.second, max_contacts, &found->contact.geom, sizeof(FoundContact));
}

int OdeWorld::collide_with_terrain(const Pair& pair, FoundContact* found) {
  static_assert(terrain_contact::max_contacts <= max_contacts);
  const GeomOwner& terrain = owner_of(pair.second);
  terrain_contact::ConvexShape shape = owner_of(pair.first).convex;
  dQuaternion q;
  dGeomGetQuaternion(pair.first, q);
  shape.pose = {vector_of(dGeomGetPosition(pair.first)), quaternion_of(q)};
  terrain_contact::TerrainContacts contacts;
  const int count = terrain_contact::find_contacts(terrain.heightmap, terrain.pose, shape, 0, contacts);
  for (int i = 0; i < count; ++i) {
    const terrain_contact::TerrainContact& c = contacts[std::size_t(i)];
    dContactGeom& geom = found[i].contact.geom;
    std::copy_n(c.position.data(), 3, geom.pos);
    std::copy_n(c.normal.data(), 3, geom.normal);
    geom.depth = -c.gap;
    geom.g1 = pair.first;
    geom.g2 = pair.second;
    geom.side1 = geom.side2 = -1;
  }
  return count;
}

/// Finds contacts. Elements of the array are reused from step to step.
void OdeWorld::find_contacts() {
  contact_count_ = 0;
  for (const Pair& p : pairs_) {
    if (found_contacts_.size() < contact_count_ + max_contacts)
      found_contacts_.resize(2 * (contact_count_ + max_contacts));
    FoundContact* const unused = found_contacts_.data() + contact_count_;
    const int n = collide(p, unused);
    for (int i = 0; i < n; ++i) {
      FoundContact& c = unused[i];
      c.first = &owner_of(p.first);
      c.second = &owner_of(p.second);
      dContactGeom& geom = c.contact.geom;
      if (geom.g1 == p.first) continue;
      std::swap(geom.g1, geom.g2);
      std::swap(geom.side1, geom.side2);
      for (int k = 0; k < 3; ++k) geom.normal[k] = -geom.normal[k];
    }
    contact_count_ += std::size_t(n);
  }
}

}  // namespace muro::ode
