// SPDX-License-Identifier: MIT
#include "bullet_robot.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

#include "invert_positive_definite.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::bullet {

using multibody::RigidBody, multibody::BodyState, multibody::RobotModel, multibody::RobotState;

namespace {

constexpr double unbounded = 1e30;
constexpr double fast_rotation = 0.05;  ///< rad in a step

/// Returns the principal moments and axes of a tensor.
std::pair<Vec3, Quat> principal(const Mat3& tensor) {
  const Mat3 off_diagonal = tensor - Mat3(tensor.diagonal().asDiagonal());
  if (off_diagonal.cwiseAbs().maxCoeff() <= 1e-14 * tensor.diagonal().maxCoeff())
    return {tensor.diagonal(), Quat::Identity()};
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(tensor);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  return {solver.eigenvalues(), Quat(axes)};
}

/// Whether a body is a wheel: it turns about an axis of symmetry that the base holds, so turning changes only its own
/// momentum.
bool is_wheel(const RigidBody& body) {
  const Inertia& i = body.inertia;
  const Vec3 offset = i.com - body.axis * body.axis.dot(i.com);
  const double about_axis = body.axis.dot(Vec3(i.tensor() * body.axis)),
               across = 0.5 * (i.tensor().trace() - about_axis);
  const Mat3 symmetric = across * Mat3::Identity() + (about_axis - across) * body.axis * body.axis.transpose();
  return body.parent == 0 && body.joint == JointKind::revolute && offset.norm() < 1e-6 &&
         (i.tensor() - symmetric).norm() <= 1e-6 * i.tensor().norm();
}

bool is_spherical(const Vec3& moments) { return moments.maxCoeff() - moments.minCoeff() <= 1e-12 * moments.maxCoeff(); }

}  // namespace

BulletRobot::BulletRobot(const RobotModel& model, RobotState& state)
    : model_(&model),
      state_(&state),
      body_states_(model.bodies.size()),
      bullet_(int(model.bodies.size()) - 1, model.bodies[0].inertia.mass,
              to_bullet(principal(model.bodies[0].inertia.tensor()).first), model.fixed_base, false),
      motion_subspaces_(model.bodies.size(), SpatialForce::Zero()),
      composites_(model.bodies.size()) {
  for (const RigidBody& body : model.bodies) {
    const auto [moments, axes] = principal(body.inertia.tensor());
    principal_inertias_.push_back({axes, moments});
  }
  for (std::size_t i = 1; i < model.bodies.size(); ++i) {
    add_link(i);
    has_only_wheels_ = has_only_wheels_ && is_wheel(model.bodies[i]);
  }
  bullet_.finalizeMultiDof();
  bullet_.setLinearDamping(0);
  bullet_.setAngularDamping(0);
  bullet_.setUseGyroTerm(model.bodies.size() > 1);
  bullet_.setMaxCoordinateVelocity(unbounded);
  const auto n = Eigen::Index(5 + model.bodies.size());
  velocity_.setZero(n);
  position_velocity_.setZero(n);
  damping_impulses_.setZero(n - 6);
  coupling_.setZero(n);
  inverse_inertia_.setZero(n, n);
  const Eigen::Index free = model.fixed_base ? n - 6 : n;
  inertia_.setZero(free, free);
}

void BulletRobot::add_link(std::size_t number) {
  const RigidBody& body = model_->bodies[number];
  const auto parent = std::size_t(body.parent);
  const Inertia &own = body.inertia, &others = model_->bodies[parent].inertia;
  const Quat back = principal_inertias_[number].axes.conjugate();
  const Quat turn = back * body.origin.orientation.conjugate() * principal_inertias_[parent].axes;
  const btVector3 axis = to_bullet(back * body.axis),
                  to_joint =
                      to_bullet(principal_inertias_[parent].axes.conjugate() * (body.origin.position - others.com)),
                  to_centre = to_bullet(back * own.com);
  const auto set_up = body.joint == JointKind::revolute ? &btMultiBody::setupRevolute : &btMultiBody::setupPrismatic;
  (bullet_.*set_up)(int(number) - 1, own.mass, to_bullet(principal_inertias_[number].moments), body.parent - 1,
                    to_bullet(turn), axis, to_joint, to_centre, true);
}

void BulletRobot::prepare(const Vec3& gravity, double dt, ArticulatedBodyScratch& scratch) {
  base_com_ = com_of(0);
  has_contact_ = false;
  find_motion_subspaces();
  set_bullet_state();
  add_forces(gravity, dt);
  find_free_velocity(dt, scratch);
  find_inverse_inertia(dt);
}

/// Solves v' = v + dt a((v + v') / 2) by fixed-point iterations. If velocity terms (Coriolis, gyroscopic) used the
/// start of the step only, nutation would grow without end.
void BulletRobot::find_free_velocity(double dt, ArticulatedBodyScratch& scratch) {
  const Eigen::Index n = velocity_.size();
  position_velocity_ = Eigen::Map<const Vector>(bullet_.getVelocityVector(), n);  // at the beginning
  const int iterations = fixed_point_iterations(dt);
  for (int i = 0; i < iterations; ++i) {
    bullet_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, scratch.numbers, scratch.vectors, scratch.matrices,
                                                                 false, false, false);
    velocity_ = position_velocity_ + dt * Eigen::Map<const Vector>(&scratch.numbers[bullet_.getNumDofs()], n);
    if (i + 1 == iterations) return;
    const Vector& end = velocity_;
    const auto mean = [&](Eigen::Index k) { return 0.5 * (position_velocity_[k] + end[k]); };
    bullet_.setBaseOmega({mean(0), mean(1), mean(2)});
    bullet_.setBaseVel({mean(3), mean(4), mean(5)});
    for (std::size_t k = 1; k < body_states_.size(); ++k) bullet_.setJointVel(int(k) - 1, mean(Eigen::Index(5 + k)));
  }
}

int BulletRobot::fixed_point_iterations(double dt) const {
  if (body_states_.size() == 1) return 1;  // see add_gyroscopic_torque()
  double spin = 0;
  for (const BodyState& body : body_states_) spin = std::max(spin, body.twist.angular.squaredNorm());
  if (spin * dt * dt > fast_rotation * fast_rotation) return 3;
  return has_only_wheels_ ? 1 : 2;
}

void BulletRobot::set_bullet_state() {
  const BodyState& base = body_states_[0];
  bullet_.setBasePos(to_bullet(base_com_));
  bullet_.setWorldToBaseRot(to_bullet(Quat((base.pose.orientation * principal_inertias_[0].axes).conjugate())));
  const bool moves = !model_->fixed_base;
  bullet_.setBaseOmega(moves ? to_bullet(base.twist.angular) : btVector3(0, 0, 0));
  bullet_.setBaseVel(moves ? to_bullet(base.twist.at(base_com_ - base.pose.position)) : btVector3(0, 0, 0));
  for (std::size_t i = 1; i < body_states_.size(); ++i) {
    bullet_.setJointPos(int(i) - 1, state_->joints[i].position);
    bullet_.setJointVel(int(i) - 1, state_->joints[i].velocity);
  }
}

void BulletRobot::add_forces(const Vec3& gravity, double dt) {
  bullet_.clearForcesAndTorques();
  for (std::size_t i = 0; i < body_states_.size(); ++i) {
    Vec3 force = model_->bodies[i].inertia.mass * gravity, torque = Vec3::Zero();
    if (state_->has_external_wrench) {
      const Wrench& w = state_->external[i];
      force += w.force;
      torque = w.torque - (body_states_[i].pose.orientation * model_->bodies[i].inertia.com).cross(w.force);
    }
    if (i == 0) {
      bullet_.addBaseForce(to_bullet(force));
      bullet_.addBaseTorque(to_bullet(torque));
      continue;
    }
    const int link = int(i) - 1;
    bullet_.addLinkForce(link, to_bullet(force));
    bullet_.addLinkTorque(link, to_bullet(torque));
    if (!state_->joints[i].target.tracks_velocity) bullet_.addJointTorque(link, state_->joints[i].target.effort);
  }
  rotation_correction_ = Quat::Identity();
  if (body_states_.size() == 1 && !model_->fixed_base) add_gyroscopic_torque(dt);
}

/// Keeps the angular momentum of a free body by the midpoint rule (Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, VII.5). Bullet gets the change of spin as a torque, and finish() adds the rotation that the spin at the
/// end of the step alone would miss.
void BulletRobot::add_gyroscopic_torque(double dt) {
  const Vec3 spin = body_states_[0].twist.angular;
  if (is_spherical(principal_inertias_[0].moments) || spin.isZero(0)) return;
  const Quat axes = body_states_[0].pose.orientation * principal_inertias_[0].axes;
  const Vec3& moments = principal_inertias_[0].moments;
  const auto times = [&](const Quat& q, const Vec3& m, const Vec3& v) {
    return Vec3(q * Vec3(m.cwiseProduct(q.conjugate() * v)));
  };
  const Vec3 momentum = times(axes, moments, spin);
  const Quat half = rotation_of(0.5 * dt * spin) * axes;
  const Vec3 middle = times(half, moments.cwiseInverse(), momentum);
  const Quat rotation = rotation_of(dt * middle);
  const Vec3 end = times(rotation * axes, moments.cwiseInverse(), momentum);
  bullet_.addBaseTorque(to_bullet(Vec3(times(axes, moments, end - spin) / dt)));
  rotation_correction_ = rotation * rotation_of(-dt * end);
}

void BulletRobot::find_motion_subspaces() {
  for (std::size_t i = 1; i < body_states_.size(); ++i) {
    const RigidBody& body = model_->bodies[i];
    const Vec3 axis = body_states_[i].pose.orientation * body.axis;
    if (body.joint == JointKind::revolute)
      motion_subspaces_[i] << axis, axis.cross(base_com_ - body_states_[i].pose.position);
    else
      motion_subspaces_[i] << Vec3::Zero(), axis;
  }
}

void BulletRobot::add_jacobian(std::size_t body, const SpatialForce& wrench, double sign, double* row) const {
  if (!model_->fixed_base)
    for (int k = 0; k < 6; ++k) row[k] += sign * wrench[k];
  for (std::size_t i = body; i > 0; i = std::size_t(model_->bodies[i].parent))
    row[5 + i] += sign * motion_subspaces_[i].dot(wrench);
}

void BulletRobot::find_inverse_inertia(double dt) {
  if (body_states_.size() == 1) {
    if (model_->fixed_base) return;
    const Quat axes = body_states_[0].pose.orientation * principal_inertias_[0].axes;
    const Mat3 r = axes.toRotationMatrix();
    inverse_inertia_.topLeftCorner<3, 3>() =
        r * principal_inertias_[0].moments.cwiseInverse().asDiagonal() * r.transpose();
    inverse_inertia_.bottomRightCorner<3, 3>().diagonal().setConstant(1 / model_->bodies[0].inertia.mass);
    return;
  }
  find_inertia(dt);
  const Eigen::Index free = inertia_.rows(), all = inverse_inertia_.rows();
  invert_positive_definite(inertia_.data(), int(free), inverse_inertia_.data() + (all - free) * (all + 1), int(all));
  // So far the bodies have moved without damping, which acts on velocities at the end of the step (implicit Euler), and
  // without the rotors of drives, which resist a change of velocity.
  for (std::size_t i = 1; i < body_states_.size(); ++i) {
    const JointLimits& limits = model_->bodies[i].limits;
    const auto k = Eigen::Index(5 + i);
    damping_impulses_[Eigen::Index(i) - 1] =
        dt * limits.damping * velocity_[k] +
        (limits.armature + state_->joints[i].drive_armature) * (velocity_[k] - position_velocity_[k]);
  }
  for (std::size_t i = 1; i < body_states_.size(); ++i)
    if (const double impulse = damping_impulses_[Eigen::Index(i) - 1]; impulse != 0)
      velocity_ -= impulse * inverse_inertia_.col(Eigen::Index(5 + i));
  couple_mimic_joints();
}

/// Removes the motions that mimic joints do not allow from the velocities and the inverse inertia, one constraint after
/// the other. Then all later impulses keep the constraints.
void BulletRobot::couple_mimic_joints() {
  for (std::size_t i = 1; i < body_states_.size(); ++i) {
    const RigidBody& body = model_->bodies[i];
    if (body.leader < 0) continue;
    const Eigen::Index follower = Eigen::Index(5 + i), leader = 5 + body.leader;
    const auto lead = [&](const Vector& v) { return v[follower] - body.multiplier * v[leader]; };
    coupling_ = inverse_inertia_.col(follower) - body.multiplier * inverse_inertia_.col(leader);
    const double inverse_mass = lead(coupling_);
    if (!(inverse_mass > 0)) continue;
    velocity_ += (state_->joints[i].target.mimic_lead - lead(velocity_)) / inverse_mass * coupling_;
    inverse_inertia_.noalias() -= coupling_ * (coupling_.transpose() / inverse_mass);
  }
}

/// Computes the inertia matrix by the composite-rigid-body algorithm (Featherstone, Rigid Body Dynamics Algorithms,
/// 6.2) about the base's centre of mass. Adds the armature and dt times the damping of joints.
void BulletRobot::find_inertia(double dt) {
  for (std::size_t i = 0; i < body_states_.size(); ++i) {
    const Inertia& inertia = model_->bodies[i].inertia;
    const Mat3 r = (body_states_[i].pose.orientation * principal_inertias_[i].axes).toRotationMatrix();
    const Vec3 arm = body_states_[i].pose * inertia.com - base_com_;
    Composite& c = composites_[i];
    c.mass = inertia.mass;
    c.first_moment = inertia.mass * arm;
    c.inertia = r * principal_inertias_[i].moments.asDiagonal() * r.transpose();
    c.inertia += inertia.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  const Eigen::Index base = model_->fixed_base ? -1 : 5;  // body i's joint is at base + i
  inertia_.setZero();
  for (std::size_t i = body_states_.size() - 1; i > 0; --i) {
    const Composite& c = composites_[i];
    const auto spin = motion_subspaces_[i].head<3>(), move = motion_subspaces_[i].tail<3>();
    SpatialForce momentum;
    momentum << c.inertia * spin + c.first_moment.cross(move), c.mass * move + spin.cross(c.first_moment);
    const Eigen::Index row = base + Eigen::Index(i);
    const JointLimits& limits = model_->bodies[i].limits;
    inertia_(row, row) =
        motion_subspaces_[i].dot(momentum) + limits.armature + state_->joints[i].drive_armature + dt * limits.damping;
    for (auto k = std::size_t(model_->bodies[i].parent); k > 0; k = std::size_t(model_->bodies[k].parent))
      inertia_(row, base + Eigen::Index(k)) = motion_subspaces_[k].dot(momentum);
    if (!model_->fixed_base) inertia_.block<1, 6>(row, 0) = momentum.transpose();
    Composite& on = composites_[std::size_t(model_->bodies[i].parent)];
    on.mass += c.mass;
    on.first_moment += c.first_moment;
    on.inertia += c.inertia;
  }
  if (model_->fixed_base) return;
  const Composite& all = composites_[0];
  Mat3 cross;
  const Vec3& m = all.first_moment;
  cross << 0, -m.z(), m.y(), m.z(), 0, -m.x(), -m.y(), m.x(), 0;
  inertia_.topLeftCorner<3, 3>() = all.inertia;
  inertia_.block<3, 3>(3, 0) = -cross;
  inertia_.block<3, 3>(3, 3) = all.mass * Mat3::Identity();
}

void BulletRobot::finish(const Vec3& gravity, double dt) {
  for (std::size_t i = 1; i < body_states_.size(); ++i) {
    multibody::JointState& joint = state_->joints[i];
    joint.velocity = velocity_[Eigen::Index(5 + i)];
    joint.position += dt * position_velocity_[Eigen::Index(5 + i)];
  }
  if (model_->fixed_base) return;
  const Vec3 spin = velocity_.head<3>(), speed = velocity_.segment<3>(3);
  const Vec3 position_spin = position_velocity_.head<3>(), position_speed = position_velocity_.segment<3>(3);
  Quat& q = state_->pose.orientation;
  q = Quat(rotation_correction_ * rotation_of(dt * position_spin) * body_states_[0].pose.orientation).normalized();
  const Vec3 arm = q * model_->bodies[0].inertia.com;
  state_->pose.position = base_com_ + dt * position_speed - arm;
  if (!has_contact_ && !state_->has_external_wrench) state_->pose.position -= 0.5 * dt * dt * gravity;
  state_->twist = {speed - spin.cross(arm), spin};
}

}  // namespace muro::bullet
