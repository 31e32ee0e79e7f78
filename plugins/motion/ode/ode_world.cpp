// SPDX-License-Identifier: MIT
#include "ode_world.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "muro/algorithm.hpp"

namespace muro::ode {

using multibody::MotionType;

namespace {

/// ODE keeps one random number generator a process, so its worlds take their steps one behind the other.
std::mutex& step_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// ODE cannot destroy what an error has left half done: it stays.
void abandon(std::vector<void*> parts) {
  static std::mutex mutex;
  static auto& abandoned = *new std::vector<std::vector<void*>>;
  const std::lock_guard lock(mutex);
  abandoned.push_back(std::move(parts));
}

constexpr double deep_softness = 0.1;   ///< see softness_of
constexpr int max_contacts = 8;         ///< of two geoms
constexpr double sliding_speed = 1e-2;  ///< m/s

}  // namespace

OdeWorld::OdeWorld(const OdeSettings& settings, std::shared_ptr<const OdeMeshes> meshes,
                   std::shared_ptr<MessageLog> messages)
    : settings_(settings), meshes_(std::move(meshes)), messages_(std::move(messages)) {
  start_library();
  prepare_this_thread();
  world_ = dWorldCreate();
  // Its own, for a failure leaves it with a step half done.
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
  owners_.push_back({std::uint32_t(owners_.size()), -1, 0, shape.loaded_link, shape.shape.surface});
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
  feedbacks_.reserve(64);
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
    create_contact_joints();
    step_world(dt);
    for (OdeRobot& r : robots_) r.export_state(dt);
    export_contacts();
    dJointGroupEmpty(contact_joints_);
  });
}

/// The softness of what has none of its own, the rows that hold joints together, is that of the heaviest body.
void OdeWorld::set_step(double dt) {
  dt_ = dt;
  double heaviest = 0;
  for (const OdeRobot& r : robots_)
    for (const multibody::RigidBody& b : r.model().bodies) heaviest = std::max(heaviest, b.inertia.mass);
  dWorldSetCFM(world_, settings_.cfm + (heaviest > 0 ? settings_.softness * dt / heaviest : 0));
  for (OdeRobot& r : robots_) r.set_step(dt);
}

/// In 1/(N s/m): ODE adds it, over the time step, to the inverse effective mass.
double OdeWorld::softness_of(const FoundContact& found) const {
  const Vec3 point = vector_of(found.contact.geom.pos), normal = vector_of(found.contact.geom.normal);
  double inverse = 0;
  for (const GeomOwner* owner : {found.first, found.second})
    if (owner->robot >= 0)
      inverse += robots_[std::size_t(owner->robot)].inverse_effective_mass(owner->body, point, normal);
  // What is deep in a body is often pushed from several sides at once, which no forces can fulfil.
  const bool is_deep = settings_.erp * found.contact.geom.depth > settings_.correcting_speed * dt_;
  return settings_.cfm + (is_deep ? std::max(settings_.softness, deep_softness) : settings_.softness) * dt_ * inverse;
}

void OdeWorld::step_world(double dt) {
  const std::lock_guard lock(step_mutex());
  dRandSetSeed(1);
  const int succeeded = settings_.exact ? dWorldStep(world_, dt) : dWorldQuickStep(world_, dt);
  if (!succeeded) throw Error("ODE has no memory for a step");
}

/// Pairs of geoms whose boxes overlap and of which at least one belongs to a robot that the world moves.
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

/// ODE does not look whether geoms of two spaces are enabled.
void OdeWorld::add_pair(dGeomID a, dGeomID b) {
  if (!dGeomIsEnabled(a) || !dGeomIsEnabled(b)) return;
  const GeomOwner *first = &owner_of(a), *second = &owner_of(b);
  if (first->robot < 0 || (second->robot >= 0 && second->number < first->number)) {
    std::swap(first, second);
    std::swap(a, b);
  }
  if (may_collide(*first, *second)) pairs_.push_back({a, b, first->number, second->number});
}

/// `a` belongs to a robot.
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

/// Writes what is found into elements that are there already, from step to step.
void OdeWorld::find_contacts() {
  contact_count_ = 0;
  for (const Pair& p : pairs_) {
    if (found_contacts_.size() < contact_count_ + max_contacts)
      found_contacts_.resize(2 * (contact_count_ + max_contacts));
    FoundContact* const unused = found_contacts_.data() + contact_count_;
    const int n = collide(p, unused);
    for (int i = 0; i < n; ++i) unused[i].first = &owner_of(p.first), unused[i].second = &owner_of(p.second);
    contact_count_ += std::size_t(n);
  }
}

void OdeWorld::create_contact_joints() {
  if (settings_.reactions) feedbacks_.assign(contact_count_, dJointFeedback{});
  for (std::size_t i = 0; i < contact_count_; ++i) {
    FoundContact& found = found_contacts_[i];
    dContactGeom& geom = found.contact.geom;
    if (found.second->scenery)
      robots_[std::size_t(found.first->robot)].state().overlap.add(geom.depth, found.first->loaded_link,
                                                                   *found.second->scenery);
    dSurfaceParameters& surface = found.contact.surface;  // what its mode does not name is not read
    surface.mode = dContactApprox1 | dContactSoftCFM | dContactSlip1 | dContactSlip2;
    surface.soft_cfm = surface.slip1 = surface.slip2 = softness_of(found);
    const Surface pair = pair_surface(found.first->surface, found.second->surface, settings_.friction_rule);
    surface.mu = pair.friction;
    if (pair.restitution > 0) {
      surface.mode |= dContactBounce;
      surface.bounce = pair.restitution;
      surface.bounce_vel = settings_.bounce_speed;
    }
    if (pair.rolling_resistance > 0 || pair.spinning_resistance > 0) {
      surface.mode |= dContactRolling | dContactAxisDep;
      surface.mu2 = pair.friction;
      surface.rho = surface.rho2 = pair.rolling_resistance;
      surface.rhoN = pair.spinning_resistance;
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
      std::copy_n(Vec3(slip / speed).data(), 3, found.contact.fdir1);
      if (speed > sliding_speed) {
        surface.mode |= dContactMu2;
        surface.mu2 = 0;
      }
    }
    const dJointID joint = dJointCreateContact(world_, contact_joints_, &found.contact);
    dJointAttach(joint, a, b);
    if (settings_.reactions) dJointSetFeedback(joint, &feedbacks_[i]);
  }
}

/// To both robots, as far as the world moves them.
void OdeWorld::tell_contact(const FoundContact& found, const dJointFeedback* feedback, bool first_is_g1) {
  const auto is_dynamic = [this](const GeomOwner& owner) {
    return owner.robot >= 0 && robots_[std::size_t(owner.robot)].motion_type() == MotionType::dynamic;
  };
  if (is_dynamic(*found.first)) tell_contact_to(*found.first, *found.second, found, feedback, first_is_g1);
  if (is_dynamic(*found.second) && found.second->robot != found.first->robot)
    tell_contact_to(*found.second, *found.first, found, feedback, first_is_g1);
}

/// ODE's torque is about the centre of mass.
void OdeWorld::tell_contact_to(const GeomOwner& self, const GeomOwner& other, const FoundContact& found,
                               const dJointFeedback* feedback, bool first_is_g1) {
  const dContactGeom& geom = found.contact.geom;
  multibody::RobotState& state = robots_[std::size_t(self.robot)].state();
  if (!state.tells_contacts) return;
  const bool is_g1 = &owner_of(geom.g1) == &self;
  const Vec3 point = vector_of(geom.pos), normal = vector_of(geom.normal);
  ContactWrench told{self.object, other.object, point, is_g1 ? normal : Vec3(-normal), geom.depth};
  if (feedback) {
    const bool is_first = is_g1 == first_is_g1;
    told.wrench.force = vector_of(is_first ? feedback->f1 : feedback->f2);
    const dBodyID body = dGeomGetBody(is_g1 ? geom.g1 : geom.g2);
    const Vec3 centre = vector_of(dBodyGetPosition(body)) - dt_ * vector_of(dBodyGetLinearVel(body));  // as it was then
    told.wrench.torque = vector_of(is_first ? feedback->t1 : feedback->t2) - (point - centre).cross(told.wrench.force);
  } else {
    told.wrench.force.setConstant(NAN);
    told.wrench.torque.setConstant(NAN);
  }
  state.contacts.push_back(told);
}

void OdeWorld::export_contacts() {
  for (std::size_t i = 0; i < contact_count_; ++i) {
    const dContactGeom& geom = found_contacts_[i].contact.geom;
    // The first of the joint's bodies is that of g1, or of g2 where g1 has none.
    const bool first_is_g1 = dGeomGetBody(geom.g1) != nullptr;
    const dJointFeedback* const f = settings_.reactions ? &feedbacks_[i] : nullptr;
    tell_contact(found_contacts_[i], f, first_is_g1);
    const GeomOwner& of_first = owner_of(first_is_g1 ? geom.g1 : geom.g2);
    const GeomOwner& of_second = owner_of(first_is_g1 ? geom.g2 : geom.g1);
    const Vec3 unknown = Vec3::Constant(NAN);
    if (of_first.robot >= 0)
      robots_[std::size_t(of_first.robot)].add_contact(of_first, f ? vector_of(f->f1) : unknown,
                                                       f ? vector_of(f->t1) : unknown);
    if (of_second.robot >= 0)
      robots_[std::size_t(of_second.robot)].add_contact(of_second, f ? vector_of(f->f2) : unknown,
                                                        f ? vector_of(f->t2) : unknown);
  }
}

}  // namespace muro::ode
