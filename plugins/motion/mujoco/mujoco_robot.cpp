// SPDX-License-Identifier: MIT
#include "mujoco_robot.hpp"

#include <cmath>

#include "mjcf.hpp"
#include "plugins/motion/common/multibody/free_rotation.hpp"

namespace muro::mujoco {

using multibody::JointState, multibody::RigidBody, multibody::MotionType;

namespace {

/// An effort above that of any drive.
constexpr double unlimited = 1e30;

Quat quaternion_of(const mjtNum* q) { return Quat(q[0], q[1], q[2], q[3]); }
void copy(mjtNum* to, const Vec3& v) { std::copy_n(v.data(), 3, to); }
void copy(mjtNum* to, const Quat& q) {
  to[0] = q.w();
  to[1] = q.x();
  to[2] = q.y();
  to[3] = q.z();
}

}  // namespace

void MujocoRobot::find_indices(mjModel& m) {
  const std::size_t n = model_->bodies.size();
  bodies_.assign(n, -1);
  joints_.assign(n, -1);
  positions_.assign(n, -1);
  dofs_.assign(n, -1);
  efforts_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = Mjcf::body_name(model_->name, owner_, i);
    bodies_[i] = mj_name2id(&m, mjOBJ_BODY, name.c_str());
    // the compiler changes moments that no solid body has
    copy(m.body_inertia + 3 * bodies_[i], principal_of(model_->bodies[i].inertia).moments);
    if (i == 0) continue;
    joints_[i] = mj_name2id(&m, mjOBJ_JOINT, name.c_str());
    dofs_[i] = m.jnt_dofadr[joints_[i]];
    positions_[i] = m.jnt_qposadr[joints_[i]];
    if (model_->bodies[i].leader >= 0) couplings_.push_back(mj_name2id(&m, mjOBJ_EQUALITY, name.c_str()));
  }
  dof_count_ = int(memory_of(*model_));
  const int base = bodies_[0];
  mocap_ = m.body_mocapid[base];
  if (mocap_ < 0) {
    first_dof_ = m.body_dofadr[base];
    base_position_ = m.jnt_qposadr[m.body_jntadr[base]];
  } else if (n > 1) {
    first_dof_ = *std::min_element(dofs_.begin() + 1, dofs_.end());
  }
}

void MujocoRobot::set_time_step(mjModel& m, double dt) {
  dt_ = dt;
  motion_type_.reset();
  std::fill_n(m.dof_armature + first_dof_, dof_count_, 0.0);
  for (std::size_t i = 1; i < dofs_.size(); ++i) {
    const JointLimits& limits = model_->bodies[i].limits;
    m.dof_armature[dofs_[i]] = limits.armature + dt * limits.damping;
  }
}

void MujocoRobot::set_motion_type(mjModel& m) {
  if (motion_type_ == state_->motion_type) return;
  const bool dynamic = state_->motion_type == MotionType::dynamic,
             disabled = state_->motion_type == MotionType::disabled;
  set_time_step(m, dt_);
  if (!dynamic) std::fill_n(m.dof_armature + first_dof_, dof_count_, kinematic_armature);
  for (const int equality : couplings_) m.eq_active[equality] = dynamic;
  for (const int b : bodies_)
    for (int g = m.body_geomadr[b]; g < m.body_geomadr[b] + m.body_geomnum[b]; ++g) {
      m.geom_contype[g] = disabled ? 0 : dynamic ? dynamic_bit : fixed_bit;
      m.geom_conaffinity[g] = dynamic ? dynamic_bit | fixed_bit : 0;
    }
  motion_type_ = state_->motion_type;
}

void MujocoRobot::import(mjModel& m, mjData& d, std::span<DofDrive> drives) {
  set_motion_type(m);
  set_state(d);
  std::fill(efforts_.begin(), efforts_.end(), 0.0);
  state_->clear_contacts();
  for (std::size_t i = 1; i < dofs_.size(); ++i) set_joint(m, d, i, drives);
}

void MujocoRobot::set_state(mjData& d) const {
  const multibody::RobotState& s = *state_;
  if (mocap_ >= 0) {
    copy(d.mocap_pos + 3 * mocap_, s.pose.position);
    copy(d.mocap_quat + 4 * mocap_, s.pose.orientation);
  } else {
    const Vec3 arm = s.pose.orientation * model_->bodies[0].inertia.com;
    copy(d.qpos + base_position_, Vec3(s.pose.position + arm));
    copy(d.qpos + base_position_ + 3, s.pose.orientation);
    copy(d.qvel + first_dof_, s.twist.at(arm));
    copy(d.qvel + first_dof_ + 3, Vec3(s.pose.orientation.conjugate() * s.twist.angular));
  }
  for (std::size_t i = 1; i < dofs_.size(); ++i) {
    d.qpos[positions_[i]] = s.joints[i].position;
    d.qvel[dofs_[i]] = s.joints[i].velocity;
  }
  if (motion_type_ == MotionType::dynamic)
    std::copy_n(s.memory.begin(), dof_count_, d.qacc_warmstart + first_dof_);
  else
    std::fill_n(d.qacc_warmstart + first_dof_, dof_count_, 0.0);
}

/// Cancels MuJoCo's gyroscopic torque, because Euler's equations are solved after the step: see export_state. MuJoCo
/// has the spin in axes of the body.
void MujocoRobot::cancel_gyroscopic_torque(mjData& d) const {
  const Vec3 spin = vector_of(d.qvel + first_dof_ + 3);
  copy(d.qfrc_applied + first_dof_ + 3, Vec3(spin.cross(model_->bodies[0].inertia.tensor() * spin)));
}

void MujocoRobot::set_forces(mjData& d) {
  if (rotates_exactly_) cancel_gyroscopic_torque(d);
  const bool has_forces = state_->has_external_wrench && motion_type_ == MotionType::dynamic;
  if (!has_forces && !has_forces_) return;
  has_forces_ = has_forces;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Wrench w = has_forces ? state_->external[i] : Wrench{};
    const Vec3 arm = rotated(d, i, model_->bodies[i].inertia.com);
    copy(d.xfrc_applied + 6 * bodies_[i], w.force);
    copy(d.xfrc_applied + 6 * bodies_[i] + 3, Vec3(w.torque - arm.cross(w.force)));
  }
}

void MujocoRobot::set_joint(mjModel& m, mjData& d, std::size_t number, std::span<DofDrive> drives) const {
  const RigidBody& body = model_->bodies[number];
  const JointState& joint = state_->joints[number];
  const multibody::DriveTarget& target = joint.target;
  const int dof = dofs_[number], id = joints_[number];
  const bool dynamic = motion_type_ == MotionType::dynamic;
  const double velocity = target.tracks_velocity ? target.velocity : 0;
  const double max_effort = target.tracks_velocity ? target.max_effort : target.friction;
  drives[std::size_t(dof)] = {velocity, target.tracks_velocity ? target.softness() : 0, target.mimic_lead};
  m.dof_frictionloss[dof] = dynamic ? std::min(max_effort, unlimited) : 0;
  if (dynamic) m.dof_armature[dof] = body.limits.armature + dt_ * body.limits.damping + joint.drive_armature;
  d.qfrc_applied[dof] =
      dynamic ? (target.tracks_velocity ? 0 : target.effort) - body.limits.damping * joint.velocity : 0;
  m.jnt_limited[id] = dynamic && (std::isfinite(body.limits.lower) || std::isfinite(body.limits.upper));
  m.jnt_range[2 * id] = body.limits.lower;
  m.jnt_range[2 * id + 1] = body.limits.upper;
  m.jnt_margin[id] = 2 * dt_ * std::max(std::abs(joint.velocity), std::abs(velocity));
}

void MujocoRobot::export_state(const mjData& d) {
  if (motion_type_ != MotionType::dynamic) return;
  multibody::RobotState& s = *state_;
  if (mocap_ < 0) {
    const Quat start = s.pose.orientation;
    s.pose.orientation = quaternion_of(d.qpos + base_position_ + 3);
    s.twist.angular = s.pose.orientation * vector_of(d.qvel + first_dof_ + 3);
    if (rotates_exactly_) {
      const Mat3 inertia = model_->bodies[0].inertia.tensor();
      multibody::FreeRotation free{start, start * vector_of(d.qvel + first_dof_ + 3)};
      free.advance(inertia, inertia.inverse(), dt_);
      s.pose.orientation = free.orientation;
      s.twist.angular = free.spin;
    }
    const Vec3 arm = s.pose.orientation * model_->bodies[0].inertia.com;
    s.pose.position = vector_of(d.qpos + base_position_) - arm;
    s.twist.linear = vector_of(d.qvel + first_dof_) - s.twist.angular.cross(arm);
  }
  for (std::size_t i = 1; i < dofs_.size(); ++i) {
    JointState& joint = s.joints[i];
    joint.position = d.qpos[positions_[i]];
    joint.velocity = d.qvel[dofs_[i]];
    joint.effort = joint.target.tracks_velocity ? efforts_[i] : joint.target.effort;
  }
  std::copy_n(d.qacc_warmstart + first_dof_, dof_count_, s.memory.begin());
}

Vec3 MujocoRobot::rotated(const mjData& d, std::size_t number, const Vec3& v) const {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(d.xmat + 9 * bodies_[number]) * v;
}

void MujocoRobot::add_contact(const mjData& d, std::uint32_t body, std::uint32_t loaded_link, const Vec3& force,
                              const Vec3& torque, const Vec3& point) const {
  Vec3 origin = vector_of(d.xpos + 3 * bodies_[body]);
  if (body == 0 && mocap_ < 0) origin -= rotated(d, 0, model_->bodies[0].inertia.com);
  state_->contact[loaded_link].add_force(force, point - origin);
  state_->contact[loaded_link].torque += torque;
}

}  // namespace muro::mujoco
