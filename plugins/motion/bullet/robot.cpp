// SPDX-License-Identifier: MIT
#include "robot.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

#include "inverse.hpp"

namespace muro::bullet {

using multibody::Part, multibody::PartMotion, multibody::RobotModel, multibody::RobotState;

namespace {

constexpr double unbounded = 1e30;
constexpr double fast = 0.05;  ///< rad in a step

/// Principal moments and axes of a tensor.
std::pair<Vec3, Quat> principal(const Mat3& tensor) {
  const Mat3 off = tensor - Mat3(tensor.diagonal().asDiagonal());
  if (off.cwiseAbs().maxCoeff() <= 1e-14 * tensor.diagonal().maxCoeff()) return {tensor.diagonal(), Quat::Identity()};
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(tensor);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  return {solver.eigenvalues(), Quat(axes)};
}

/// Turns about an axis of symmetry that is held by the base: its turning changes nothing but its own momentum.
bool is_wheel(const Part& p) {
  const Inertia& i = p.inertia;
  const Vec3 off = i.com - p.axis * p.axis.dot(i.com), turned = i.tensor() * p.axis;
  const double own = p.axis.dot(turned), others = 0.5 * (i.tensor().trace() - own);
  const Mat3 symmetric = others * Mat3::Identity() + (own - others) * p.axis * p.axis.transpose();
  return p.parent == 0 && p.joint == JointKind::revolute && off.norm() < 1e-6 &&
         (i.tensor() - symmetric).norm() <= 1e-6 * i.tensor().norm();
}

bool is_even(const Vec3& moments) { return moments.maxCoeff() - moments.minCoeff() <= 1e-12 * moments.maxCoeff(); }

}  // namespace

Robot::Robot(const RobotModel& model, RobotState& state)
    : model_(&model),
      state_(&state),
      parts_(model.parts.size()),
      bullet_(int(model.parts.size()) - 1, model.parts[0].inertia.mass,
              bullet(principal(model.parts[0].inertia.tensor()).first), model.fixed_base, false),
      joints_(model.parts.size(), Wrench6::Zero()),
      composites_(model.parts.size()) {
  for (const Part& p : model.parts) {
    const auto [moments, axes] = principal(p.inertia.tensor());
    bodies_.push_back({axes, moments});
  }
  for (std::size_t i = 1; i < model.parts.size(); ++i) {
    add_link(i);
    has_only_wheels_ = has_only_wheels_ && is_wheel(model.parts[i]);
  }
  bullet_.finalizeMultiDof();
  bullet_.setLinearDamping(0);
  bullet_.setAngularDamping(0);
  bullet_.setUseGyroTerm(model.parts.size() > 1);
  bullet_.setMaxCoordinateVelocity(unbounded);
  const auto n = Eigen::Index(5 + model.parts.size());
  velocity_.setZero(n);
  moving_.setZero(n);
  joints_damping_.setZero(n - 6);
  response_.setZero(n, n);
  const Eigen::Index free = model.fixed_base ? n - 6 : n;
  inertia_.setZero(free, free);
}

void Robot::add_link(std::size_t number) {
  const Part& part = model_->parts[number];
  const auto on = std::size_t(part.parent);
  const Inertia &own = part.inertia, &others = model_->parts[on].inertia;
  const Quat back = bodies_[number].axes.conjugate();
  const Quat turn = back * part.origin.orientation.conjugate() * bodies_[on].axes;
  const btVector3 axis = bullet(back * part.axis),
                  to_joint = bullet(bodies_[on].axes.conjugate() * (part.origin.position - others.com)),
                  to_centre = bullet(back * own.com);
  const auto set_up = part.joint == JointKind::revolute ? &btMultiBody::setupRevolute : &btMultiBody::setupPrismatic;
  (bullet_.*set_up)(int(number) - 1, own.mass, bullet(bodies_[number].moments), part.parent - 1, bullet(turn), axis,
                    to_joint, to_centre, true);
}

void Robot::prepare(const Vec3& gravity, double dt, Scratch& scratch) {
  centre_ = centre_of(0);
  touched_ = false;
  find_joints();
  set_bullet();
  add_forces(gravity, dt);
  move_freely(dt, scratch);
  find_response(dt);
}

/// v' = v + dt a((v + v') / 2) by so many turns of a fixed point: what depends on velocities (Coriolis, gyroscopic) at
/// the beginning of the step alone would feed nutation until it bursts.
void Robot::move_freely(double dt, Scratch& scratch) {
  const Eigen::Index n = velocity_.size();
  moving_ = Eigen::Map<const Vector>(bullet_.getVelocityVector(), n);  // at the beginning
  const int passes = passes_of(dt);
  for (int i = 0; i < passes; ++i) {
    bullet_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, scratch.numbers, scratch.vectors, scratch.matrices,
                                                                 false, false, false);
    velocity_ = moving_ + dt * Eigen::Map<const Vector>(&scratch.numbers[bullet_.getNumDofs()], n);
    if (i + 1 == passes) return;
    const Vector& end = velocity_;
    const auto mean = [&](Eigen::Index k) { return 0.5 * (moving_[k] + end[k]); };
    bullet_.setBaseOmega({mean(0), mean(1), mean(2)});
    bullet_.setBaseVel({mean(3), mean(4), mean(5)});
    for (std::size_t k = 1; k < parts_.size(); ++k) bullet_.setJointVel(int(k) - 1, mean(Eigen::Index(5 + k)));
  }
}

int Robot::passes_of(double dt) const {
  if (parts_.size() == 1) return 1;  // see spin_freely()
  double spin = 0;
  for (const PartMotion& part : parts_) spin = std::max(spin, part.twist.angular.squaredNorm());
  if (spin * dt * dt > fast * fast) return 3;
  return has_only_wheels_ ? 1 : 2;
}

void Robot::set_bullet() {
  const PartMotion& base = parts_[0];
  bullet_.setBasePos(bullet(centre_));
  bullet_.setWorldToBaseRot(bullet(Quat((base.pose.orientation * bodies_[0].axes).conjugate())));
  const bool moves = !model_->fixed_base;
  bullet_.setBaseOmega(moves ? bullet(base.twist.angular) : btVector3(0, 0, 0));
  bullet_.setBaseVel(moves ? bullet(base.twist.at(centre_ - base.pose.position)) : btVector3(0, 0, 0));
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    bullet_.setJointPos(int(i) - 1, state_->joints[i].position);
    bullet_.setJointVel(int(i) - 1, state_->joints[i].velocity);
  }
}

void Robot::add_forces(const Vec3& gravity, double dt) {
  bullet_.clearForcesAndTorques();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Vec3 force = model_->parts[i].inertia.mass * gravity, torque = Vec3::Zero();
    if (state_->applied) {
      const Wrench& w = state_->external[i];
      force += w.force;
      torque = w.torque - (parts_[i].pose.orientation * model_->parts[i].inertia.com).cross(w.force);
    }
    if (i == 0) {
      bullet_.addBaseForce(bullet(force));
      bullet_.addBaseTorque(bullet(torque));
      continue;
    }
    const int link = int(i) - 1;
    bullet_.addLinkForce(link, bullet(force));
    bullet_.addLinkTorque(link, bullet(torque));
    if (!state_->joints[i].demand.by_speed) bullet_.addJointTorque(link, state_->joints[i].demand.effort);
  }
  turn_correction_ = Quat::Identity();
  if (parts_.size() == 1 && !model_->fixed_base) spin_freely(dt);
}

/// A free body keeps its angular momentum: midpoint rule (Hairer, Lubich, Wanner, Geometric Numerical Integration,
/// VII.5). Bullet is given the change of spin as a torque, and finish() turns by what the end spin alone would miss.
void Robot::spin_freely(double dt) {
  const Vec3 spin = parts_[0].twist.angular;
  if (is_even(bodies_[0].moments) || spin.isZero(0)) return;
  const Quat axes = parts_[0].pose.orientation * bodies_[0].axes;
  const Vec3& moments = bodies_[0].moments;
  const auto times = [&](const Quat& q, const Vec3& m, const Vec3& v) {
    return Vec3(q * Vec3(m.cwiseProduct(q.conjugate() * v)));
  };
  const Vec3 momentum = times(axes, moments, spin);
  const Quat half = rotation_of(0.5 * dt * spin) * axes;
  const Vec3 middle = times(half, moments.cwiseInverse(), momentum);
  const Quat turn = rotation_of(dt * middle);
  const Vec3 end = times(turn * axes, moments.cwiseInverse(), momentum);
  bullet_.addBaseTorque(bullet(Vec3(times(axes, moments, end - spin) / dt)));
  turn_correction_ = turn * rotation_of(-dt * end);
}

void Robot::find_joints() {
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const Part& part = model_->parts[i];
    const Vec3 axis = parts_[i].pose.orientation * part.axis;
    if (part.joint == JointKind::revolute)
      joints_[i] << axis, axis.cross(centre_ - parts_[i].pose.position);
    else
      joints_[i] << Vec3::Zero(), axis;
  }
}

void Robot::add_row(std::size_t part, const Wrench6& wrench, double sign, double* row) const {
  if (!model_->fixed_base)
    for (int k = 0; k < 6; ++k) row[k] += sign * wrench[k];
  for (std::size_t i = part; i > 0; i = std::size_t(model_->parts[i].parent))
    row[5 + i] += sign * joints_[i].dot(wrench);
}

void Robot::find_response(double dt) {
  if (parts_.size() == 1) {
    if (model_->fixed_base) return;
    const Quat axes = parts_[0].pose.orientation * bodies_[0].axes;
    const Mat3 r = axes.toRotationMatrix();
    response_.topLeftCorner<3, 3>() = r * bodies_[0].moments.cwiseInverse().asDiagonal() * r.transpose();
    response_.bottomRightCorner<3, 3>().diagonal().setConstant(1 / model_->parts[0].inertia.mass);
    return;
  }
  find_inertia(dt);
  const Eigen::Index free = inertia_.rows(), all = response_.rows();
  invert(inertia_.data(), int(free), response_.data() + (all - free) * (all + 1), int(all));
  // The bodies have moved on without damping, which acts on velocities at the end of the step: implicit Euler.
  for (std::size_t i = 1; i < parts_.size(); ++i)
    joints_damping_[Eigen::Index(i) - 1] = dt * model_->parts[i].limits.damping * velocity_[Eigen::Index(5 + i)];
  for (std::size_t i = 1; i < parts_.size(); ++i)
    if (const double impulse = joints_damping_[Eigen::Index(i) - 1]; impulse != 0)
      velocity_ -= impulse * response_.col(Eigen::Index(5 + i));
}

/// Composite-rigid-body algorithm (Featherstone, Rigid Body Dynamics Algorithms, 6.2), all about the base's centre of
/// mass, with dt times the damping of joints added.
void Robot::find_inertia(double dt) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Inertia& inertia = model_->parts[i].inertia;
    const Mat3 r = (parts_[i].pose.orientation * bodies_[i].axes).toRotationMatrix();
    const Vec3 arm = parts_[i].pose * inertia.com - centre_;
    Composite& c = composites_[i];
    c.mass = inertia.mass;
    c.moment = inertia.mass * arm;
    c.inertia = r * bodies_[i].moments.asDiagonal() * r.transpose();
    c.inertia += inertia.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  const Eigen::Index base = model_->fixed_base ? -1 : 5;  // part i's joint is at base + i
  inertia_.setZero();
  for (std::size_t i = parts_.size() - 1; i > 0; --i) {
    const Composite& c = composites_[i];
    const auto spin = joints_[i].head<3>(), move = joints_[i].tail<3>();
    Wrench6 momentum;
    momentum << c.inertia * spin + c.moment.cross(move), c.mass * move + spin.cross(c.moment);
    const Eigen::Index row = base + Eigen::Index(i);
    inertia_(row, row) = joints_[i].dot(momentum) + dt * model_->parts[i].limits.damping;
    for (auto k = std::size_t(model_->parts[i].parent); k > 0; k = std::size_t(model_->parts[k].parent))
      inertia_(row, base + Eigen::Index(k)) = joints_[k].dot(momentum);
    if (!model_->fixed_base) inertia_.block<1, 6>(row, 0) = momentum.transpose();
    Composite& on = composites_[std::size_t(model_->parts[i].parent)];
    on.mass += c.mass;
    on.moment += c.moment;
    on.inertia += c.inertia;
  }
  if (model_->fixed_base) return;
  const Composite& all = composites_[0];
  Mat3 cross;
  const Vec3& m = all.moment;
  cross << 0, -m.z(), m.y(), m.z(), 0, -m.x(), -m.y(), m.x(), 0;
  inertia_.topLeftCorner<3, 3>() = all.inertia;
  inertia_.block<3, 3>(3, 0) = -cross;
  inertia_.block<3, 3>(3, 3) = all.mass * Mat3::Identity();
}

void Robot::finish(const Vec3& gravity, double dt) {
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    multibody::JointState& joint = state_->joints[i];
    joint.velocity = velocity_[Eigen::Index(5 + i)];
    joint.position += dt * moving_[Eigen::Index(5 + i)];
  }
  if (model_->fixed_base) return;
  const Vec3 spin = velocity_.head<3>(), speed = velocity_.segment<3>(3);
  const Vec3 turning = moving_.head<3>(), moving = moving_.segment<3>(3);
  Quat& q = state_->pose.orientation;
  q = Quat(turn_correction_ * rotation_of(dt * turning) * parts_[0].pose.orientation).normalized();
  const Vec3 arm = q * model_->parts[0].inertia.com;
  state_->pose.position = centre_ + dt * moving - arm;
  if (!touched_ && !state_->applied) state_->pose.position -= 0.5 * dt * dt * gravity;
  state_->twist = {speed - spin.cross(arm), spin};
}

}  // namespace muro::bullet
