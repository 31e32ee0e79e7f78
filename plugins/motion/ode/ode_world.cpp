// SPDX-License-Identifier: MIT
#include "ode_world.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "muro/algorithm.hpp"

namespace muro::ode {

using multibody::Presence;

namespace {

/// ODE keeps one random number generator a process, so its worlds take their steps one behind the other.
std::mutex& stepping() {
  static std::mutex mutex;
  return mutex;
}

/// ODE wants to know each thread that collides.
void know_this_thread() {
  thread_local const bool known = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  if (!known) throw Error("ODE has no memory for a thread");
}

constexpr int most_contacts = 8;        ///< of two geoms
constexpr double sliding_speed = 1e-2;  ///< m/s

}  // namespace

void start_engine() {
  struct Engine {  // counted by ODE: others in the process may use it as well
    bool runs = dInitODE2(0) != 0;
    ~Engine() {
      if (runs) dCloseODE();
    }
  };
  static const Engine engine;
  if (!engine.runs) throw Error("ODE cannot be started");
}

OdeWorld::OdeWorld(const Settings& settings, std::shared_ptr<const Meshes> meshes)
    : settings_(settings), meshes_(std::move(meshes)) {
  start_engine();
  know_this_thread();
  world_ = dWorldCreate();
  dWorldSetGravity(world_, settings.gravity.x(), settings.gravity.y(), settings.gravity.z());
  dWorldSetERP(world_, settings.erp);
  dWorldSetCFM(world_, settings.cfm);
  dWorldSetQuickStepNumIterations(world_, settings.iterations);
  dWorldSetContactMaxCorrectingVel(world_, settings.correcting_speed);
  dWorldSetAutoDisableFlag(world_, 0);
  contacts_ = dJointGroupCreate(0);
  scenery_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  others_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  team_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
}

OdeWorld::~OdeWorld() {
  dJointGroupDestroy(contacts_);
  for (const dGeomID plane : planes_) dGeomDestroy(plane);
  dSpaceDestroy(team_);
  dSpaceDestroy(others_);
  dSpaceDestroy(scenery_);
  dWorldDestroy(world_);
}

void OdeWorld::mark(dGeomID geom, const multibody::PartShape& shape) {
  owners_.push_back({std::uint32_t(owners_.size()), -1, 0, shape.body, shape.shape.friction, shape.shape.restitution});
  dGeomSetData(geom, &owners_.back());
}

void OdeWorld::add_scenery(const multibody::Fixture& fixture) {
  for (const multibody::PartShape& s : fixture.shapes) {
    const bool plane = s.shape.kind == ShapeKind::plane;
    const dGeomID geom =
        make_geom(s.shape, fixture.pose * s.shape.origin, nullptr, plane ? nullptr : scenery_, *meshes_);
    if (!geom) continue;
    mark(geom, s);
    if (plane) planes_.push_back(geom);
  }
}

void OdeWorld::add_obstacle(const multibody::Fixture& fixture, const multibody::FixtureState& state) {
  Obstacle& o = obstacles_.emplace_back();
  o.state = &state;
  o.body = dBodyCreate(world_);
  dBodySetKinematic(o.body);
  for (const multibody::PartShape& s : fixture.shapes)
    if (const dGeomID geom = make_geom(s.shape, s.shape.origin, o.body, others_, *meshes_)) {
      mark(geom, s);
      o.geoms.push_back(geom);
    }
}

void OdeWorld::add_robot(const multibody::RobotModel& model, multibody::RobotState& state) {
  const dSpaceID space = dSimpleSpaceCreate(team_);
  dSpaceSetSublevel(space, 1);
  robots_.emplace_back(world_, space, model, state, std::int32_t(robots_.size()), owners_, *meshes_,
                       settings_.reactions);
}

void OdeWorld::complete() {
  pairs_.reserve(64);
  touches_.resize(64);
  feedbacks_.reserve(64);
}

void OdeWorld::import(Obstacle& o) const {
  const bool present = o.state->presence == Presence::obstacle;
  if (present != o.present) {
    o.present = present;
    for (const dGeomID geom : o.geoms) present ? dGeomEnable(geom) : dGeomDisable(geom);
    present ? dBodyEnable(o.body) : dBodyDisable(o.body);
  }
  if (!present) return;
  const Vec3& p = o.state->pose.position;
  const Quat& q = o.state->pose.orientation;
  const Vec3 &v = o.state->twist.linear, &w = o.state->twist.angular;
  const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
  dBodySetPosition(o.body, p.x(), p.y(), p.z());
  dBodySetQuaternion(o.body, turn);
  dBodySetLinearVel(o.body, v.x(), v.y(), v.z());
  dBodySetAngularVel(o.body, w.x(), w.y(), w.z());
}

void OdeWorld::advance(double dt) {
  know_this_thread();
  for (Obstacle& o : obstacles_) import(o);
  for (Robot& r : robots_) r.import();
  find_pairs();
  find_touches();
  make_contacts();
  carry_on(dt);
  for (Robot& r : robots_) r.export_state(dt);
  if (settings_.reactions) export_contacts();
  dJointGroupEmpty(contacts_);
}

void OdeWorld::carry_on(double dt) {
  const std::lock_guard lock(stepping());
  dRandSetSeed(1);
  const int fine = settings_.exact ? dWorldStep(world_, dt) : dWorldQuickStep(world_, dt);
  if (!fine) throw Error("ODE has no memory for a step");
}

/// Pairs of geoms whose boxes overlap and of which at least one belongs to a robot that the world moves.
void OdeWorld::find_pairs() {
  pairs_.clear();
  for (const Robot& r : robots_) {
    if (r.presence() != Presence::simulated) continue;
    for (const dGeomID geom : r.geoms())
      for (const dGeomID plane : planes_) add_pair(geom, plane);
    if (r.model().self_collision) dSpaceCollide(r.space(), this, &meet);
  }
  dSpaceCollide2(reinterpret_cast<dGeomID>(team_), reinterpret_cast<dGeomID>(scenery_), this, &meet);
  dSpaceCollide2(reinterpret_cast<dGeomID>(team_), reinterpret_cast<dGeomID>(others_), this, &meet);
  dSpaceCollide(team_, this, &meet);
  const auto before = [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; };
  if (!std::is_sorted(pairs_.begin(), pairs_.end(), before)) std::sort(pairs_.begin(), pairs_.end(), before);
}

void OdeWorld::meet(void* self, dGeomID a, dGeomID b) {
  if (dGeomIsSpace(a) || dGeomIsSpace(b))
    dSpaceCollide2(a, b, self, &meet);
  else
    static_cast<OdeWorld*>(self)->add_pair(a, b);
}

/// Spaces that meet do not look whether geoms are enabled.
void OdeWorld::add_pair(dGeomID a, dGeomID b) {
  if (!dGeomIsEnabled(a) || !dGeomIsEnabled(b)) return;
  const Owner *first = &owner_of(a), *second = &owner_of(b);
  if (first->robot < 0 || (second->robot >= 0 && second->number < first->number)) {
    std::swap(first, second);
    std::swap(a, b);
  }
  if (may_touch(*first, *second)) pairs_.push_back({a, b, first->number, second->number});
}

/// `a` belongs to a robot.
bool OdeWorld::may_touch(const Owner& a, const Owner& b) const {
  const Robot& robot = robots_[std::size_t(a.robot)];
  if (b.robot == a.robot)
    return robot.model().self_collision && a.part != b.part && !robot.model().adjacent(a.part, b.part);
  return robot.presence() == Presence::simulated ||
         (b.robot >= 0 && robots_[std::size_t(b.robot)].presence() == Presence::simulated);
}

/// Writes what ODE finds into places that are there already, from step to step.
void OdeWorld::find_touches() {
  touch_count_ = 0;
  for (const Pair& p : pairs_) {
    if (touches_.size() < touch_count_ + most_contacts) touches_.resize(2 * (touch_count_ + most_contacts));
    Touch* const free = touches_.data() + touch_count_;
    const int n = dCollide(p.first, p.second, most_contacts, &free->contact.geom, sizeof(Touch));
    for (int i = 0; i < n; ++i) free[i].first = &owner_of(p.first), free[i].second = &owner_of(p.second);
    touch_count_ += std::size_t(n);
  }
}

void OdeWorld::make_contacts() {
  if (settings_.reactions) feedbacks_.assign(touch_count_, dJointFeedback{});
  for (std::size_t i = 0; i < touch_count_; ++i) {
    Touch& t = touches_[i];
    dContactGeom& geom = t.contact.geom;
    dSurfaceParameters& surface = t.contact.surface;  // what its mode does not name is not read
    surface.mode = dContactApprox1;
    surface.mu = std::sqrt(t.first->friction * t.second->friction);
    surface.mu2 = 0;
    const double restitution = std::max(t.first->restitution, t.second->restitution);
    if (restitution > 0) {
      surface.mode |= dContactBounce;
      surface.bounce = restitution;
      surface.bounce_vel = settings_.bounce_speed;
    }
    const dBodyID a = dGeomGetBody(geom.g1), b = dGeomGetBody(geom.g2);
    // ODE bounds friction along two directions, each for itself. With the first along the slip, and no friction across
    // it while bodies slide, it is that of a cone.
    dVector3 of_a{}, of_b{};
    const dReal* p = geom.pos;
    if (a) dBodyGetPointVel(a, p[0], p[1], p[2], of_a);
    if (b) dBodyGetPointVel(b, p[0], p[1], p[2], of_b);
    const Vec3 normal = vector_of(geom.normal), relative = vector_of(of_a) - vector_of(of_b);
    const Vec3 slip = relative - normal * normal.dot(relative);
    if (const double speed = slip.norm(); speed > 1e-9) {
      surface.mode |= dContactFDir1;
      std::copy_n(Vec3(slip / speed).data(), 3, t.contact.fdir1);
      if (speed > sliding_speed) surface.mode |= dContactMu2;
    }
    const dJointID joint = dJointCreateContact(world_, contacts_, &t.contact);
    dJointAttach(joint, a, b);
    if (settings_.reactions) dJointSetFeedback(joint, &feedbacks_[i]);
  }
}

void OdeWorld::export_contacts() {
  for (std::size_t i = 0; i < touch_count_; ++i) {
    const dContactGeom& geom = touches_[i].contact.geom;
    const dJointFeedback& f = feedbacks_[i];
    // The first of the joint's bodies is that of g1, or of g2 where g1 has none.
    const bool first_is_g1 = dGeomGetBody(geom.g1) != nullptr;
    const Owner& of_first = owner_of(first_is_g1 ? geom.g1 : geom.g2);
    const Owner& of_second = owner_of(first_is_g1 ? geom.g2 : geom.g1);
    if (of_first.robot >= 0)
      robots_[std::size_t(of_first.robot)].add_contact(of_first, vector_of(f.f1), vector_of(f.t1));
    if (of_second.robot >= 0)
      robots_[std::size_t(of_second.robot)].add_contact(of_second, vector_of(f.f2), vector_of(f.t2));
  }
}

}  // namespace muro::ode
