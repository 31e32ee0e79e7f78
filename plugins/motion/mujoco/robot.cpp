// SPDX-License-Identifier: MIT
#include "robot.hpp"

#include <cmath>

#include "mjcf.hpp"

namespace muro::mujoco {

using multibody::JointState, multibody::Part, multibody::Presence;

namespace {

/// A bound of effort that no drive reaches.
constexpr double unlimited = 1e30;

Vec3 vector_of(const mjtNum* v) { return {v[0], v[1], v[2]}; }
Quat quaternion_of(const mjtNum* q) { return Quat(q[0], q[1], q[2], q[3]); }
void copy(mjtNum* to, const Vec3& v) { std::copy_n(v.data(), 3, to); }
void copy(mjtNum* to, const Quat& q) {
  to[0] = q.w();
  to[1] = q.x();
  to[2] = q.y();
  to[3] = q.z();
}

}  // namespace

void Robot::find(mjModel& m) {
  const std::size_t n = model_->parts.size();
  bodies_.assign(n, -1);
  joints_.assign(n, -1);
  positions_.assign(n, -1);
  dofs_.assign(n, -1);
  efforts_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = Mjcf::body_name(model_->name, owner_, i);
    bodies_[i] = mj_name2id(&m, mjOBJ_BODY, name.c_str());
    // the compiler evens out moments that no solid body has
    copy(m.body_inertia + 3 * bodies_[i], principal_of(model_->parts[i].inertia).moments);
    if (i == 0) continue;
    joints_[i] = mj_name2id(&m, mjOBJ_JOINT, name.c_str());
    dofs_[i] = m.jnt_dofadr[joints_[i]];
    positions_[i] = m.jnt_qposadr[joints_[i]];
  }
  count_ = int(memory_of(*model_));
  const int base = bodies_[0];
  mocap_ = m.body_mocapid[base];
  if (mocap_ < 0) {
    first_ = m.body_dofadr[base];
    position_ = m.jnt_qposadr[m.body_jntadr[base]];
  } else if (n > 1) {
    first_ = *std::min_element(dofs_.begin() + 1, dofs_.end());
  }
}

void Robot::set_step(mjModel& m, double dt) {
  dt_ = dt;
  presence_.reset();
  std::fill_n(m.dof_armature + first_, count_, 0.0);
  for (std::size_t i = 1; i < dofs_.size(); ++i) m.dof_armature[dofs_[i]] = dt * model_->parts[i].limits.damping;
}

void Robot::set_presence(mjModel& m) {
  if (presence_ == state_->presence) return;
  const bool simulated = state_->presence == Presence::simulated, absent = state_->presence == Presence::absent;
  set_step(m, dt_);
  if (!simulated) std::fill_n(m.dof_armature + first_, count_, immovable);
  for (const int b : bodies_)
    for (int g = m.body_geomadr[b]; g < m.body_geomadr[b] + m.body_geomnum[b]; ++g) {
      m.geom_contype[g] = absent ? 0 : simulated ? moved : unmoved;
      m.geom_conaffinity[g] = simulated ? moved | unmoved : 0;
    }
  presence_ = state_->presence;
}

void Robot::import(mjModel& m, mjData& d, std::span<double> wanted) {
  set_presence(m);
  place(d);
  std::fill(efforts_.begin(), efforts_.end(), 0.0);
  for (Wrench& w : state_->contact) w = Wrench{};
  for (std::size_t i = 1; i < dofs_.size(); ++i) set_joint(m, d, i, wanted);
}

void Robot::place(mjData& d) const {
  const multibody::RobotState& s = *state_;
  if (mocap_ >= 0) {
    copy(d.mocap_pos + 3 * mocap_, s.pose.position);
    copy(d.mocap_quat + 4 * mocap_, s.pose.orientation);
  } else {
    const Vec3 arm = s.pose.orientation * model_->parts[0].inertia.com;
    copy(d.qpos + position_, Vec3(s.pose.position + arm));
    copy(d.qpos + position_ + 3, s.pose.orientation);
    copy(d.qvel + first_, s.twist.at(arm));
    copy(d.qvel + first_ + 3, Vec3(s.pose.orientation.conjugate() * s.twist.angular));
  }
  for (std::size_t i = 1; i < dofs_.size(); ++i) {
    d.qpos[positions_[i]] = s.joints[i].position;
    d.qvel[dofs_[i]] = s.joints[i].velocity;
  }
  if (presence_ == Presence::simulated)
    std::copy_n(s.memory.begin(), count_, d.qacc_warmstart + first_);
  else
    std::fill_n(d.qacc_warmstart + first_, count_, 0.0);
}

void Robot::set_forces(mjData& d) {
  const bool push = state_->applied && presence_ == Presence::simulated;
  if (!push && !pushed_) return;
  pushed_ = push;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Wrench w = push ? state_->external[i] : Wrench{};
    const Vec3 arm = turned(d, i, model_->parts[i].inertia.com);
    copy(d.xfrc_applied + 6 * bodies_[i], w.force);
    copy(d.xfrc_applied + 6 * bodies_[i] + 3, Vec3(w.torque - arm.cross(w.force)));
  }
}

void Robot::set_joint(mjModel& m, mjData& d, std::size_t number, std::span<double> wanted) const {
  const Part& part = model_->parts[number];
  const JointState& joint = state_->joints[number];
  const multibody::Demand& demand = joint.demand;
  const int dof = dofs_[number], id = joints_[number];
  const bool simulated = presence_ == Presence::simulated;
  const double goal = demand.by_speed ? demand.speed : 0, bound = demand.by_speed ? demand.most : part.limits.friction;
  wanted[std::size_t(dof)] = goal;
  m.dof_frictionloss[dof] = simulated ? std::min(bound, unlimited) : 0;
  d.qfrc_applied[dof] = simulated ? (demand.by_speed ? 0 : demand.effort) - part.limits.damping * joint.velocity : 0;
  m.jnt_limited[id] = simulated && (std::isfinite(part.limits.lower) || std::isfinite(part.limits.upper));
  m.jnt_range[2 * id] = part.limits.lower;
  m.jnt_range[2 * id + 1] = part.limits.upper;
  m.jnt_margin[id] = 2 * dt_ * std::max(std::abs(joint.velocity), std::abs(goal));
}

void Robot::export_state(const mjData& d) {
  if (presence_ != Presence::simulated) return;
  multibody::RobotState& s = *state_;
  if (mocap_ < 0) {
    s.pose.orientation = quaternion_of(d.qpos + position_ + 3);
    s.twist.angular = s.pose.orientation * vector_of(d.qvel + first_ + 3);
    const Vec3 arm = s.pose.orientation * model_->parts[0].inertia.com;
    s.pose.position = vector_of(d.qpos + position_) - arm;
    s.twist.linear = vector_of(d.qvel + first_) - s.twist.angular.cross(arm);
  }
  for (std::size_t i = 1; i < dofs_.size(); ++i) {
    JointState& joint = s.joints[i];
    joint.position = d.qpos[positions_[i]];
    joint.velocity = d.qvel[dofs_[i]];
    joint.effort = joint.demand.by_speed ? efforts_[i] : joint.demand.effort;
  }
  std::copy_n(d.qacc_warmstart + first_, count_, s.memory.begin());
}

Vec3 Robot::turned(const mjData& d, std::size_t part, const Vec3& v) const {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(d.xmat + 9 * bodies_[part]) * v;
}

void Robot::add_contact(const mjData& d, std::uint32_t part, std::uint32_t body, const Vec3& force,
                        const Vec3& point) const {
  Vec3 origin = vector_of(d.xpos + 3 * bodies_[part]);
  if (part == 0 && mocap_ < 0) origin -= turned(d, 0, model_->parts[0].inertia.com);
  state_->contact[body].add_force(force, point - origin);
}

}  // namespace muro::mujoco
