// SPDX-License-Identifier: MIT
#include "mujoco_world.hpp"

#include "muro/algorithm.hpp"

namespace muro::mujoco {

using multibody::Presence;

namespace {

/// m/s^2: sliding that changes what contacts aim at by less needs no further solution. It moves them by 20 um.
constexpr double settled = 1;
/// Numbers on MuJoCo's stack, at most.
constexpr int largest_stack = 200000000;

}  // namespace

void MujocoWorld::add_scenery(const multibody::Fixture& fixture) {
  scenery_.push_back({&fixture, owners_});
  mjcf_.add_scenery(fixture, owners_++);
}

void MujocoWorld::add_obstacle(const multibody::Fixture& fixture, const multibody::FixtureState& state) {
  obstacles_.push_back({&fixture, &state, owners_});
  mjcf_.add_obstacle(fixture, owners_++);
}

void MujocoWorld::add_robot(const multibody::RobotModel& model, multibody::RobotState& state) {
  robots_.emplace_back(model, state, owners_);
  mjcf_.add_robot(model, owners_++);
}

void MujocoWorld::complete() {
  int shapes = 0, joints = 0;
  for (const Robot& r : robots_) {
    joints += int(r.model().parts.size());
    for (const multibody::Part& p : r.model().parts) shapes += int(p.shapes.size());
  }
  const int contacts = shapes + 20;
  model_ = compile(mjcf_.text(settings_, {contacts, 2 * joints + 3 * contacts}));
  if (model_->nbody > 30000)
    throw Error("a world of MuJoCo holds 30000 bodies, this one has " + std::to_string(model_->nbody) +
                "; give some of the robots another `world`");
  model_->opt.solver = settings_.solver;
  model_->opt.iterations = settings_.iterations;
  model_->opt.tolerance = settings_.tolerance;
  model_->opt.impratio = settings_.friction_ratio;
  contacts_.prepare(settings_, std::size_t(model_->ngeom));
  drives_.resize(std::size_t(model_->nv));
  wanted_.resize(std::size_t(model_->nv));
  find_bodies();
  make_room();
}

void MujocoWorld::find_bodies() {
  const mjModel& m = *model_;
  const auto body_of = [&](const std::string& name, std::size_t owner) {
    return mj_name2id(&m, mjOBJ_BODY, Mjcf::body_name(name, owner, 0).c_str());
  };
  const auto mark = [&](int geom, const multibody::PartShape& s) -> Owner& {
    Owner& o = contacts_.owner_of(geom);
    o.body = s.body;
    o.friction = s.shape.friction;
    o.restitution = s.shape.restitution;
    return o;
  };
  for (const Scenery& s : scenery_) {
    const std::string name = Mjcf::body_name(s.fixture->name, s.owner, 0);
    for (std::size_t k = 0; k < s.fixture->shapes.size(); ++k)
      mark(mj_name2id(&m, mjOBJ_GEOM, Mjcf::geom_name(name, k).c_str()), s.fixture->shapes[k]);
  }
  for (Obstacle& o : obstacles_) {
    o.body = body_of(o.fixture->name, o.owner);
    o.mocap = m.body_mocapid[o.body];
    int geom = m.body_geomadr[o.body];
    for (const multibody::PartShape& s : o.fixture->shapes)
      if (has_geom(s)) {
        Owner& owner = mark(geom++, s);
        owner.pose = &o.state->pose;
        owner.twist = &o.state->twist;
      }
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& r = robots_[i];
    r.find(*model_);
    for (std::size_t k = 0; k < r.model().parts.size(); ++k) {
      if (k > 0) drives_[std::size_t(r.dof(k))] = {i, k};
      int geom = m.body_geomadr[r.body(k)];
      for (const multibody::PartShape& s : r.model().parts[k].shapes)
        if (has_geom(s)) {
          Owner& owner = mark(geom++, s);
          owner.robot = std::int32_t(i);
          owner.part = std::uint32_t(k);
          if (!r.model().fixed_base) continue;
          owner.pose = &r.state().pose;
          owner.twist = &r.state().twist;
        }
    }
  }
}

/// Data as big as the model says. Nothing in it outlasts a step.
void MujocoWorld::make_room() {
  mjModel& m = *model_;
  const double n = m.nv, rows = m.njmax, bodies = m.nbody;
  double stack = 3 * n * n + bodies * bodies + 40 * (rows + n + bodies) + 1000;
  if (settings_.solver == mjSOL_PGS) stack += 4 * rows * (n + rows);
  m.nstack = int(std::min(stack * stack_factor_, double(largest_stack)));
  data_.reset();
  data_ = make_data(m);
}

/// A step that found no room is taken again: all that it begins with is in the states.
void MujocoWorld::advance(double dt) {
  if (model_->nv == 0) return;
  while (true) {
    if (dt != dt_) set_step(dt);
    for (Obstacle& o : obstacles_) import(o);
    for (Robot& r : robots_) r.import(*model_, *data_, wanted_);
    try {
      step();
    } catch (const EngineError& e) {
      if (e.text != "Stack overflow" || model_->nstack >= largest_stack) throw Error("MuJoCo: " + e.text);
      stack_factor_ *= 2;
      make_room();
      continue;
    }
    const mjWarningStat* warnings = data_->warning;
    if (warnings[mjWARN_INERTIA].number)
      throw Error("MuJoCo: the inertia of a robot is too close to singular; look at masses of links that differ much");
    if (!warnings[mjWARN_CONTACTFULL].number && !warnings[mjWARN_CNSTRFULL].number) break;
    model_->njmax += 3 * model_->nconmax;
    model_->nconmax *= 2;
    make_room();
  }
  for (Robot& r : robots_) r.export_state(*data_);
  contacts_.export_wrenches(*data_, robots_);
}

void MujocoWorld::set_step(double dt) {
  dt_ = dt;
  model_->opt.timestep = dt;
  for (Robot& r : robots_) r.set_step(*model_, dt);
  mj_setConst(model_.get(), data_.get());
}

void MujocoWorld::import(Obstacle& o) {
  const bool present = o.state->presence == Presence::obstacle;
  if (present != o.present) {
    o.present = present;
    const int first = model_->body_geomadr[o.body];
    std::fill_n(model_->geom_contype + first, model_->body_geomnum[o.body], present ? unmoved : 0);
  }
  const Quat& q = o.state->pose.orientation;
  const mjtNum turn[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(o.state->pose.position.data(), 3, data_->mocap_pos + 3 * o.mocap);
  std::copy_n(turn, 4, data_->mocap_quat + 4 * o.mocap);
}

/// As mj_step, in its parts.
void MujocoWorld::step() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_collision(m, d);
  contacts_.set_friction(*d);
  mj_makeConstraint(m, d);
  mj_projectConstraint(m, d);
  mj_fwdVelocity(m, d);
  for (Robot& r : robots_) r.set_forces(*d);
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  set_references();
  contacts_.release_sliding(*m, *d, d->qacc_warmstart);
  for (int i = 0;; ++i) {
    mj_fwdConstraint(m, d);
    if (i == settings_.refinements || contacts_.release_sliding(*m, *d, d->qacc) < settled) break;
  }
  mj_Euler(m, d);
  for (int i = 0; i < d->nefc && d->efc_type[i] == mjCNSTR_FRICTION_DOF; ++i) {
    const Drive& drive = drives_[std::size_t(d->efc_id[i])];
    robots_[drive.robot].set_effort(drive.part, d->efc_force[i]);
  }
}

/// What each row of constraints is to do to its speed within the step.
void MujocoWorld::set_references() {
  mjData& d = *data_;
  if (d.ncon > 0) mj_mulJacVec(model_.get(), &d, d.efc_b, d.qacc_smooth);
  for (int i = 0; i < d.nefc; ++i) switch (d.efc_type[i]) {
      case mjCNSTR_FRICTION_DOF:
        d.efc_aref[i] = (wanted_[std::size_t(d.efc_id[i])] - d.efc_vel[i]) / dt_;
        break;
      case mjCNSTR_LIMIT_JOINT: {
        const double room = d.efc_pos[i];
        const double speed = -room / (room > 0 ? dt_ : std::max(settings_.time_constant, 2 * dt_));
        d.efc_aref[i] = (speed - d.efc_vel[i]) / dt_;
        break;
      }
      default:
        contacts_.set_reference(d, d.efc_id[i], i, dt_);
        i += d.contact[d.efc_id[i]].dim - 1;
    }
}

}  // namespace muro::mujoco
