// SPDX-License-Identifier: MIT
#include "mujoco_world.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"

namespace muro::mujoco {

using multibody::MotionType;

namespace {

/// m/s^2: when sliding changes the targets of contacts by less, no further solution is needed. It moves them by 20 um.
constexpr double sliding_tolerance = 1;
/// Largest number of values on MuJoCo's stack.
constexpr int max_stack = 200000000;

}  // namespace

void MujocoWorld::add_static_body(const multibody::ExternalBody& body) {
  static_bodies_.push_back({&body, owners_});
  mjcf_.add_static_body(body, owners_++);
}

void MujocoWorld::add_kinematic_body(const multibody::ExternalBody& body, const multibody::ExternalBodyState& state) {
  kinematic_bodies_.push_back({&body, &state, owners_});
  mjcf_.add_kinematic_body(body, owners_++);
}

void MujocoWorld::add_robot(const multibody::RobotModel& model, multibody::RobotState& state) {
  robots_.emplace_back(model, state, owners_, settings_.exact_attitude);
  mjcf_.add_robot(model, owners_++);
}

void MujocoWorld::complete() {
  int shapes = 0, joints = 0;
  for (const MujocoRobot& r : robots_) {
    joints += int(r.model().bodies.size());
    for (const multibody::RigidBody& p : r.model().bodies) shapes += int(p.shapes.size());
  }
  const int contacts = shapes + 20;
  model_ = compile(mjcf_.text(settings_, {contacts, 4 * joints + 3 * contacts}), *warnings_);
  if (model_->nbody > 30000)
    throw Error("a world of MuJoCo holds 30000 bodies, this one has " + std::to_string(model_->nbody) +
                "; give some of the robots another `world`");
  model_->opt.solver = settings_.solver;
  model_->opt.iterations = settings_.iterations;
  model_->opt.tolerance = settings_.tolerance;
  model_->opt.impratio = settings_.friction_ratio;
  contacts_.prepare(settings_, std::size_t(model_->ngeom));
  dof_owners_.resize(std::size_t(model_->nv));
  dof_drives_.resize(std::size_t(model_->nv));
  find_indices();
  allocate_data();
}

void MujocoWorld::find_indices() {
  const mjModel& m = *model_;
  const auto body_index = [&](const std::string& name, std::size_t owner) {
    return mj_name2id(&m, mjOBJ_BODY, Mjcf::body_name(name, owner, 0).c_str());
  };
  const auto set_owner = [&](int geom, const multibody::BodyShape& s) -> GeomOwner& {
    GeomOwner& owner = contacts_.owner_of(geom);
    owner.loaded_link = s.loaded_link;
    owner.object = s.object;
    owner.surface = s.shape.surface;
    owner.extent = contact_geometry::extent_of(s.shape);
    return owner;
  };
  for (const StaticBody& s : static_bodies_) {
    const std::string name = Mjcf::body_name(s.body->name, s.owner, 0);
    for (std::size_t k = 0; k < s.body->shapes.size(); ++k) {
      const Shape& shape = s.body->shapes[k].shape;
      const int geom = mj_name2id(&m, mjOBJ_GEOM, Mjcf::geom_name(name, k).c_str());
      set_owner(geom, s.body->shapes[k]).scenery = &s.body->name;
      if (shape.kind == ShapeKind::heightmap)
        contacts_.add_terrain(geom, meshes_->heightmap(shape), s.body->pose * shape.origin);
    }
  }
  for (KinematicBody& k : kinematic_bodies_) {
    k.index = body_index(k.body->name, k.owner);
    k.mocap = m.body_mocapid[k.index];
    int geom = m.body_geomadr[k.index];
    for (const multibody::BodyShape& s : k.body->shapes)
      if (has_geom(s)) {
        GeomOwner& owner = set_owner(geom++, s);
        owner.pose = &k.state->pose;
        owner.twist = &k.state->twist;
      }
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    MujocoRobot& r = robots_[i];
    r.find_indices(*model_);
    for (std::size_t k = 0; k < r.model().bodies.size(); ++k) {
      if (k > 0) dof_owners_[std::size_t(r.dof(k))] = {i, k};
      int geom = m.body_geomadr[r.body(k)];
      for (const multibody::BodyShape& s : r.model().bodies[k].shapes)
        if (has_geom(s)) {
          GeomOwner& owner = set_owner(geom++, s);
          owner.robot = std::int32_t(i);
          owner.body = std::uint32_t(k);
          owner.convex = meshes_->convex_shape(s.shape);
          owner.in_body = s.shape.origin;
          if (k == 0 && !r.model().fixed_base) owner.in_body.position -= r.model().bodies[0].inertia.com;
          if (!r.model().fixed_base) continue;
          owner.pose = &r.state().pose;
          owner.twist = &r.state().twist;
        }
    }
  }
}

/// Allocates data of the size that the model needs. Nothing in it is kept after a step.
void MujocoWorld::allocate_data() {
  mjModel& m = *model_;
  const double n = m.nv, rows = m.njmax, bodies = m.nbody;
  double stack = 3 * n * n + bodies * bodies + 40 * (rows + n + bodies) + 1000;
  if (settings_.solver == mjSOL_PGS) stack += 4 * rows * (n + rows);
  m.nstack = int(std::min(stack * stack_factor_, double(max_stack)));
  data_.reset();
  data_ = make_data(m);
}

/// Advances the world. A step without enough memory is repeated: its start is in the states.
void MujocoWorld::advance(double dt) {
  if (model_->nv == 0) return;
  while (true) {
    try {
      if (dt != dt_) set_time_step(dt);
      for (KinematicBody& k : kinematic_bodies_) import(k);
      for (MujocoRobot& r : robots_) r.import(*model_, *data_, dof_drives_);
      step();
    } catch (const LibraryError& e) {
      if (e.text.find("tack overflow") == std::string::npos || model_->nstack >= max_stack)
        throw Error("MuJoCo: " + e.text);
      dt_ = 0;
      stack_factor_ *= 2;
      allocate_data();
      continue;
    }
    const mjWarningStat* warnings = data_->warning;
    check_inertia();
    if (!warnings[mjWARN_CONTACTFULL].number && !warnings[mjWARN_CNSTRFULL].number) break;
    model_->njmax += 3 * model_->nconmax;
    model_->nconmax *= 2;
    allocate_data();
  }
  for (MujocoRobot& r : robots_) r.export_state(*data_);
  contacts_.export_wrenches(*data_, robots_);
}

void MujocoWorld::check_inertia() const {
  const mjWarningStat& singular = data_->warning[mjWARN_INERTIA];
  if (!singular.number) return;
  const std::string text = "MuJoCo: its matrix of inertia is too close to singular; look at masses that differ much";
  for (const MujocoRobot& r : robots_)
    if (r.has_dof(singular.lastinfo)) throw multibody::RobotFailure(text, r.state());
  throw Error(text);
}

void MujocoWorld::set_time_step(double dt) {
  dt_ = dt;
  model_->opt.timestep = dt;
  for (MujocoRobot& r : robots_) r.set_time_step(*model_, dt);
  mj_setConst(model_.get(), data_.get());
}

void MujocoWorld::import(KinematicBody& k) {
  const bool enabled = k.state->motion_type == MotionType::kinematic;
  if (enabled != k.enabled) {
    k.enabled = enabled;
    const int first = model_->body_geomadr[k.index];
    std::fill_n(model_->geom_contype + first, model_->body_geomnum[k.index], enabled ? fixed_bit : 0);
  }
  const Quat& q = k.state->pose.orientation;
  const mjtNum orientation[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(k.state->pose.position.data(), 3, data_->mocap_pos + 3 * k.mocap);
  std::copy_n(orientation, 4, data_->mocap_quat + 4 * k.mocap);
}

/// Makes the calls of mj_step one by one.
void MujocoWorld::step() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_tendon(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_collision(m, d);
  contacts_.find_terrain_contacts(*m, *d, robots_);
  contacts_.report_overlaps(*d, robots_);
  contacts_.set_friction(*d);
  mj_makeConstraint(m, d);
  contacts_.move_friction(*m, *d);
  set_softness();
  mj_projectConstraint(m, d);
  mj_fwdVelocity(m, d);
  for (MujocoRobot& r : robots_) r.set_forces(*d);
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  set_references();
  solve();
  if (contacts_.leave_overlaps(*d))
    split_step();
  else
    mj_Euler(m, d);
  for (int i = d->ne; i < d->nefc && d->efc_type[i] == mjCNSTR_FRICTION_DOF; ++i) {
    const DofOwner& drive = dof_owners_[std::size_t(d->efc_id[i])];
    robots_[drive.robot].set_effort(drive.body, d->efc_force[i]);
  }
}

void MujocoWorld::solve() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  contacts_.correct_for_sliding(*m, *d, d->qacc_warmstart, false);
  for (int i = 0;; ++i) {
    mj_fwdConstraint(m, d);
    if (i == settings_.refinements || contacts_.correct_for_sliding(*m, *d, d->qacc, true) < sliding_tolerance) break;
  }
}

/// Ends a step with split impulses. Velocities that correct overlaps would remain, and a landing body would rebound. So
/// they only move positions; then the rows are solved without them, which gives the velocities.
void MujocoWorld::split_step() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  positions_.assign(d->qpos, d->qpos + m->nq);
  velocities_.assign(d->qvel, d->qvel + m->nv);
  mj_Euler(m, d);
  std::swap_ranges(positions_.begin(), positions_.end(), d->qpos);
  std::copy(velocities_.begin(), velocities_.end(), d->qvel);
  d->time -= dt_;
  solve();
  mj_Euler(m, d);
  std::copy(positions_.begin(), positions_.end(), d->qpos);
}

/// Sets the softness of rows. The force of a row is (a* - J a) / R: with R = softness / dt it is a damper on the speed
/// at the end of the step.
void MujocoWorld::set_softness() {
  mjData& d = *data_;
  for (int i = d.ne; i < d.nefc && d.efc_type[i] == mjCNSTR_FRICTION_DOF; ++i) {
    const double softness = dof_drives_[std::size_t(d.efc_id[i])].softness;
    if (softness <= dt_ * d.efc_R[i]) continue;
    d.efc_R[i] = softness / dt_;
    d.efc_D[i] = 1 / d.efc_R[i];
  }
}

/// Sets the target acceleration of each row of constraints within the step.
void MujocoWorld::set_references() {
  mjData& d = *data_;
  if (d.ncon > 0) mj_mulJacVec(model_.get(), &d, d.efc_b, d.qacc_smooth);
  for (int i = 0; i < d.nefc; ++i) switch (d.efc_type[i]) {
      case mjCNSTR_EQUALITY: {
        const int follower = model_->jnt_dofadr[model_->eq_obj1id[d.efc_id[i]]];
        d.efc_aref[i] = (dof_drives_[std::size_t(follower)].mimic_lead - d.efc_vel[i]) / dt_;
        break;
      }
      case mjCNSTR_FRICTION_DOF:
        d.efc_aref[i] = (dof_drives_[std::size_t(d.efc_id[i])].velocity - d.efc_vel[i]) / dt_;
        break;
      case mjCNSTR_FRICTION_TENDON:
        d.efc_aref[i] = -d.efc_vel[i] / dt_;
        break;
      case mjCNSTR_LIMIT_JOINT: {
        const double distance = d.efc_pos[i];
        const double speed =
            distance > 0 ? -distance / dt_
                         : std::min(-distance / std::max(settings_.time_constant, 2 * dt_), settings_.correcting_speed);
        d.efc_aref[i] = (speed - d.efc_vel[i]) / dt_;
        break;
      }
      default:
        contacts_.set_reference(*model_, d, d.efc_id[i], i, dt_);
        i += d.contact[d.efc_id[i]].dim - 1;
    }
}

}  // namespace muro::mujoco
