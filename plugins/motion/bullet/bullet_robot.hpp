// SPDX-License-Identifier: MIT
// A robot in Bullet: a btMultiBody, with the data of it that contacts and drives need.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "collider.hpp"

namespace muro::bullet {

/// Scratch memory of Bullet's articulated-body algorithm.
struct ArticulatedBodyScratch {
  btAlignedObjectArray<btScalar> numbers;
  btAlignedObjectArray<btVector3> vectors;
  btAlignedObjectArray<btMatrix3x3> matrices;
};

/// A robot of a world. Generalised velocities are in Bullet's order: spin of the base, velocity of its centre of mass
/// (world axes), then joint velocities, that of body i at index 5 + i.
///
/// A step begins from RobotState alone. prepare() copies it to the btMultiBody, advances it as if nothing touched it,
/// and finds the inverse of its inertia. The solver changes velocity(). finish() advances the state.
class BulletRobot {
 public:
  using Vector = Eigen::VectorXd;
  using SpatialForce = Eigen::Matrix<double, 6, 1>;  ///< torque about the base's centre of mass, force: world axes

  BulletRobot(const multibody::RobotModel& model, multibody::RobotState& state);

  /// Computes the states of its bodies.
  void update_kinematics() { forward_kinematics(*model_, *state_, body_states_); }
  /// Computes velocities without contacts and drives at the end of a step of `dt` (s), and the inverse of the inertia.
  void prepare(const Vec3& gravity, double dt, ArticulatedBodyScratch& scratch);
  /// Advances the state with the velocities from the solver. Positions use the new velocities, but a robot without
  /// contacts takes the exact path of a fall.
  void finish(const Vec3& gravity, double dt);
  void set_has_contact() { has_contact_ = true; }

  const multibody::RobotModel& model() const { return *model_; }
  multibody::RobotState& state() { return *state_; }
  multibody::MotionType motion_type() const { return state_->motion_type; }
  bool is_dynamic() const { return state_->motion_type == multibody::MotionType::dynamic; }
  const multibody::BodyState& body_state(std::size_t i) const { return body_states_[i]; }
  btMultiBody& bullet_body() { return bullet_; }

  int size() const { return int(velocity_.size()); }  ///< size of generalised vectors
  double* velocity() { return velocity_.data(); }
  double* position_velocity() { return position_velocity_.data(); }  ///< velocity that moves positions in this step
  const double* velocity() const { return velocity_.data(); }
  /// Inverse of the joint-space inertia matrix, with armature and damping of joints and with mimic joints coupled to
  /// their leaders. Its columns are the velocities from unit impulses.
  const Eigen::MatrixXd& inverse_inertia() const { return inverse_inertia_; }
  /// Adds `sign` times the generalised force of a wrench on a body to `row`: a row of the Jacobian.
  void add_jacobian(std::size_t body, const SpatialForce& wrench, double sign, double* row) const;
  /// Returns a force along `direction` at `point` (m, world), for add_jacobian().
  SpatialForce wrench(const Vec3& point, const Vec3& direction) const {
    SpatialForce w;
    w << (point - base_com_).cross(direction), direction;
    return w;
  }

 private:
  struct PrincipalInertia {
    Quat axes;     ///< axes of the principal moments, in the frame of the body
    Vec3 moments;  ///< kg m^2
  };

  void add_link(std::size_t body);
  void set_bullet_state();
  void add_forces(const Vec3& gravity, double dt);
  void add_gyroscopic_torque(double dt);
  void find_free_velocity(double dt, ArticulatedBodyScratch& scratch);
  int fixed_point_iterations(double dt) const;
  void find_motion_subspaces();
  void find_inverse_inertia(double dt);
  void find_inertia(double dt);
  void couple_mimic_joints();
  Vec3 com_of(std::size_t body) const { return body_states_[body].pose * model_->bodies[body].inertia.com; }

  const multibody::RobotModel* model_;
  multibody::RobotState* state_;
  std::vector<PrincipalInertia> principal_inertias_;
  std::vector<multibody::BodyState> body_states_;
  btMultiBody bullet_;
  Vec3 base_com_ = Vec3::Zero();  ///< m, world: the base's centre of mass at the beginning of the step
  bool has_contact_ = false;
  bool has_only_wheels_ = true;
  Quat rotation_correction_ = Quat::Identity();
  std::vector<SpatialForce> motion_subspaces_;  ///< one per body: motion by its joint, spin and velocity at `base_com_`
  struct Composite {
    double mass = 0;
    Vec3 first_moment = Vec3::Zero();  ///< kg m, about `base_com_`
    Mat3 inertia = Mat3::Zero();       ///< about `base_com_`
  };
  std::vector<Composite> composites_;
  Vector velocity_, position_velocity_;
  Vector damping_impulses_;  ///< N s or N m s in a step, by damping and rotors, one per joint
  Vector coupling_;          ///< velocities from a unit impulse of a mimic joint's constraint
  Eigen::MatrixXd inertia_, inverse_inertia_;
};

}  // namespace muro::bullet
