// SPDX-License-Identifier: MIT
#include "model_robot.hpp"

#include <algorithm>

#include "mujoco_robot.hpp"

namespace muro::mujoco {

using multibody::MotionType;

namespace {

void put(mjtNum* to, const Vec3& v) { std::copy_n(v.data(), 3, to); }
void put(mjtNum* to, const Quat& q) {
  const mjtNum values[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(values, 4, to);
}
Quat quat_at(const mjtNum* q) { return Quat(q[0], q[1], q[2], q[3]); }

}  // namespace

ModelRobot::ModelRobot(const multibody::RobotModel& model, multibody::RobotState& state, const ModelRobotSource& source)
    : model_(&model), state_(&state), source_(&source), body_states_(model.bodies.size()) {}

void ModelRobot::find_indices(mjModel& m) {
  joints_.assign(model_->bodies.size(), {});
  dof_count_ = int(model_->bodies.size()) - 1 + (source_->is_free ? 6 : 0);
  first_dof_ = m.nv;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const std::uint32_t link = model_->bodies[i].link;
    joints_[i].has_body = source_->bodies[link] >= 0;
    if (i == 0) continue;
    const int joint = source_->joints[link];
    joints_[i].joint = joint;
    joints_[i].position = m.jnt_qposadr[joint];
    joints_[i].dof = m.jnt_dofadr[joint];
    first_dof_ = std::min(first_dof_, joints_[i].dof);
  }
  const int root = source_->root;
  if (source_->is_free) {
    first_dof_ = m.body_dofadr[root];
    free_position_ = m.jnt_qposadr[m.body_jntadr[root]];
  }
  root_pose_ = {vector_of(m.body_pos + 3 * root), quat_at(m.body_quat + 4 * root)};
  armatures_.assign(m.dof_armature + first_dof_, m.dof_armature + first_dof_ + dof_count_);
  friction_losses_.assign(m.dof_frictionloss + first_dof_, m.dof_frictionloss + first_dof_ + dof_count_);
  for (std::size_t i = 1; i < joints_.size(); ++i) {  // values of the file, or of the scenario instead
    const JointLimits& limits = model_->bodies[i].limits;
    const int dof = joints_[i].dof;
    armatures_[std::size_t(dof - first_dof_)] = limits.armature;
    friction_losses_[std::size_t(dof - first_dof_)] = m.dof_frictionloss[dof] = limits.friction;
    m.dof_damping[dof] = limits.damping;
  }
  for (int g = 0; g < m.ngeom; ++g)
    if (m.body_rootid[m.geom_bodyid[g]] == root)
      geoms_.emplace_back(g, std::pair(m.geom_contype[g], m.geom_conaffinity[g]));
  loaded_links_.assign(std::size_t(m.nbody), -1);
  for (std::size_t k = 0; k < model_->loaded_links.size(); ++k)
    if (const int body = source_->bodies[model_->loaded_links[k].link]; body >= 0)
      loaded_links_[std::size_t(body)] = std::int32_t(k);
}

void ModelRobot::set_motion_type(mjModel& m) {
  if (motion_type_ == state_->motion_type) return;
  motion_type_ = state_->motion_type;
  const bool dynamic = motion_type_ == MotionType::dynamic;
  for (int i = 0; i < dof_count_; ++i)
    m.dof_armature[first_dof_ + i] = dynamic ? armatures_[std::size_t(i)] : kinematic_armature;
  for (const auto& [geom, masks] : geoms_) {
    const bool touches = motion_type_ != MotionType::disabled;
    m.geom_contype[geom] = touches ? masks.first : 0;
    m.geom_conaffinity[geom] = touches ? masks.second : 0;
  }
}

std::span<double> ModelRobot::kept_spin() const {
  return state_->memory.subspan(std::size_t(dof_count_) + source_->activations.size(), 3);
}

/// Sets the pose of the base. A root that the world holds has the pose of the base. A base that is no body of the file
/// represents the world.
void ModelRobot::set_base(mjModel& m, mjData& d) const {
  const multibody::RobotState& s = *state_;
  if (source_->is_free) {
    put(d.qpos + free_position_, s.pose.position);
    put(d.qpos + free_position_ + 3, s.pose.orientation);
    put(d.qvel + first_dof_, s.twist.linear);
    if (s.moved_from_outside || motion_type_ != MotionType::dynamic)
      put(d.qvel + first_dof_ + 3, Vec3(s.pose.orientation.conjugate() * s.twist.angular));
    else
      std::copy_n(kept_spin().data(), 3, d.qvel + first_dof_ + 3);
    return;
  }
  const Pose root = joints_[0].has_body ? s.pose : s.pose * root_pose_;
  put(m.body_pos + 3 * source_->root, root.position);
  put(m.body_quat + 4 * source_->root, root.orientation);
}

void ModelRobot::import(mjModel& m, mjData& d) {
  set_motion_type(m);
  set_base(m, d);
  multibody::RobotState& s = *state_;
  s.clear_contacts();
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    d.qpos[joints_[i].position] = s.joints[i].position;
    d.qvel[joints_[i].dof] = s.joints[i].velocity;
  }
  const bool dynamic = motion_type_ == MotionType::dynamic;
  if (dynamic) set_drive_losses(m);
  for (int i = 0; i < dof_count_; ++i) d.qacc_warmstart[first_dof_ + i] = dynamic ? s.memory[std::size_t(i)] : 0;
  for (std::size_t i = 0; i < source_->activations.size(); ++i)
    d.act[source_->activations[i]] = dynamic ? s.memory[std::size_t(dof_count_) + i] : 0;
  set_controls(m, d);
  set_forces(m, d);
}

/// Sets friction and armature of its joints' drives, in addition to the values of the file.
void ModelRobot::set_drive_losses(mjModel& m) const {
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const multibody::JointState& joint = state_->joints[i];
    if (joint.drive_friction == 0 && joint.drive_armature == 0) continue;
    const int dof = joints_[i].dof;
    m.dof_frictionloss[dof] = friction_losses_[std::size_t(dof - first_dof_)] + joint.drive_friction;
    m.dof_armature[dof] = armatures_[std::size_t(dof - first_dof_)] + joint.drive_armature;
  }
}

/// Sets the controls. A target belongs to the joint, but a servo follows the length of its transmission: gear times the
/// position.
void ModelRobot::set_controls(const mjModel& m, mjData& d) const {
  for (const multibody::RigidBody& body : model_->bodies) {
    const ModelDrive& drive = source_->drives[body.link];
    if (drive.actuator < 0) continue;
    const double target = motion_type_ == MotionType::dynamic ? *source_->targets[body.link] : 0;
    if (!std::isfinite(target))
      throw multibody::RobotFailure("a target of its joints is not finite; look at what writes its `joint.*.target`",
                                    *state_);
    const double gear = m.actuator_gear[6 * drive.actuator], gain = m.actuator_gainprm[mjNGAIN * drive.actuator];
    d.ctrl[drive.actuator] = drive.mode == DriveMode::effort ? target / (gear * gain) : target * gear;
  }
}

void ModelRobot::set_forces(const mjModel& m, mjData& d) {
  const bool has_forces = state_->has_external_wrench && motion_type_ == MotionType::dynamic;
  if (!has_forces && !has_forces_) return;
  has_forces_ = has_forces;
  if (has_forces) forward_kinematics(*model_, *state_, body_states_);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const int body = i == 0 ? source_->root : m.jnt_bodyid[joints_[i].joint];
    if (i == 0 && !joints_[0].has_body) continue;
    const Wrench w = has_forces ? state_->external[i] : Wrench{};
    Vec3 com = vector_of(m.body_ipos + 3 * body);
    if (!joints_[i].has_body) com -= vector_of(m.jnt_pos + 3 * joints_[i].joint);
    const Vec3 arm = body_states_[i].pose.orientation * com;
    // when several joints move one body, forces act on the last
    if (!joints_[i].has_body && w.force.isZero(0) && w.torque.isZero(0)) continue;
    put(d.xfrc_applied + 6 * body, w.force);
    put(d.xfrc_applied + 6 * body + 3, Vec3(w.torque - arm.cross(w.force)));
  }
}

void ModelRobot::export_state(const mjData& d) {
  if (motion_type_ != MotionType::dynamic) return;
  multibody::RobotState& s = *state_;
  if (source_->is_free) {
    s.pose = {vector_of(d.qpos + free_position_), quat_at(d.qpos + free_position_ + 3)};
    s.twist.linear = vector_of(d.qvel + first_dof_);
    s.twist.angular = s.pose.orientation * vector_of(d.qvel + first_dof_ + 3);
    std::copy_n(d.qvel + first_dof_ + 3, 3, kept_spin().data());
  }
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    s.joints[i].position = d.qpos[joints_[i].position];
    s.joints[i].velocity = d.qvel[joints_[i].dof];
    s.joints[i].effort = d.qfrc_actuator[joints_[i].dof];
  }
  for (int i = 0; i < dof_count_; ++i) s.memory[std::size_t(i)] = d.qacc_warmstart[first_dof_ + i];
  for (std::size_t i = 0; i < source_->activations.size(); ++i)
    s.memory[std::size_t(dof_count_) + i] = d.act[source_->activations[i]];
}

/// Returns the origin of a body of the model at the time when the contacts of the last step were found.
Vec3 ModelRobot::origin_of(const mjData& d, std::uint32_t body) const {
  const Joint& joint = joints_[body];
  if (joint.has_body) return vector_of(d.xpos + 3 * source_->bodies[model_->bodies[body].link]);
  return body == 0 ? state_->pose.position : vector_of(d.xanchor + 3 * joint.joint);
}

void ModelRobot::add_contact(const mjData& d, int body, const Vec3& force, const Vec3& torque,
                             const Vec3& point) const {
  const std::int32_t link = loaded_links_[std::size_t(body)];
  if (link < 0) return;
  Wrench& contact = state_->contact[std::size_t(link)];
  contact.add_force(force, point - origin_of(d, model_->loaded_links[std::size_t(link)].placement.body));
  contact.torque += torque;
}

void ModelRobot::add_overlap(int body, double depth, const std::string& obstacle) {
  if (const std::int32_t link = loaded_links_[std::size_t(body)]; link >= 0)
    state_->overlap.add(depth, std::uint32_t(link), obstacle);
}

}  // namespace muro::mujoco
