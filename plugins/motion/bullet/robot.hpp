// SPDX-License-Identifier: MIT
// A robot in Bullet: a btMultiBody, with what its contacts and drives need to know of it.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "collider.hpp"

namespace muro::bullet {

/// What Bullet's articulated-body algorithm works in.
struct Scratch {
  btAlignedObjectArray<btScalar> numbers;
  btAlignedObjectArray<btVector3> vectors;
  btAlignedObjectArray<btMatrix3x3> matrices;
};

/// Generalised velocities are Bullet's: spin of the base, velocity of its centre of mass (world axes), then those of
/// the joints, part i's at 5 + i.
///
/// A step begins from RobotState alone: prepare() sets the btMultiBody to it, moves it on as if nothing touched it, and
/// finds how it answers to impulses; the solver changes velocity(); finish() carries the state on.
class Robot {
 public:
  using Vector = Eigen::VectorXd;
  using Wrench6 = Eigen::Matrix<double, 6, 1>;  ///< torque about the base's centre of mass, force: world axes

  Robot(const multibody::RobotModel& model, multibody::RobotState& state);

  /// Finds where its parts are.
  void place() { place_parts(*model_, *state_, parts_); }
  /// Finds velocities without contacts and drives at the end of a step of `dt` (s), and the answer to impulses.
  void prepare(const Vec3& gravity, double dt, Scratch& scratch);
  /// Carries the state on with the velocities that the solver has left: positions by the new velocities, but a robot
  /// that nothing has touched takes the exact path of a fall.
  void finish(const Vec3& gravity, double dt);
  void set_touched() { touched_ = true; }

  const multibody::RobotModel& model() const { return *model_; }
  multibody::RobotState& state() { return *state_; }
  multibody::Presence presence() const { return state_->presence; }
  bool simulated() const { return state_->presence == multibody::Presence::simulated; }
  const multibody::PartMotion& part(std::size_t i) const { return parts_[i]; }
  btMultiBody& bullet_body() { return bullet_; }

  int size() const { return int(velocity_.size()); }  ///< of generalised vectors
  double* velocity() { return velocity_.data(); }
  double* moving() { return moving_.data(); }  ///< velocity that moves positions in this step
  const double* velocity() const { return velocity_.data(); }
  /// What one impulse at each coordinate does to velocities: the inverse of the inertia, damping of joints included.
  const Eigen::MatrixXd& response() const { return response_; }
  /// Adds `sign` times what a wrench on a part means for each coordinate to `row`.
  void add_row(std::size_t part, const Wrench6& wrench, double sign, double* row) const;
  /// A force along `direction` at `point` (m, world), as add_row() wants it.
  Wrench6 wrench(const Vec3& point, const Vec3& direction) const {
    Wrench6 w;
    w << (point - centre_).cross(direction), direction;
    return w;
  }

 private:
  struct Body {
    Quat axes;     ///< of its principal moments, in the frame of the part
    Vec3 moments;  ///< kg m^2
  };

  void add_link(std::size_t part);
  void set_bullet();
  void add_forces(const Vec3& gravity, double dt);
  void spin_freely(double dt);
  void move_freely(double dt, Scratch& scratch);
  int passes_of(double dt) const;
  void find_joints();
  void find_response(double dt);
  void find_inertia(double dt);
  Vec3 centre_of(std::size_t part) const { return parts_[part].pose * model_->parts[part].inertia.com; }

  const multibody::RobotModel* model_;
  multibody::RobotState* state_;
  std::vector<Body> bodies_;
  std::vector<multibody::PartMotion> parts_;
  btMultiBody bullet_;
  Vec3 centre_ = Vec3::Zero();  ///< m, world: the base's centre of mass at the beginning of the step
  bool touched_ = false;
  bool has_only_wheels_ = true;
  Quat turn_correction_ = Quat::Identity();
  std::vector<Wrench6> joints_;  ///< one a part: motion of the joint, spin and velocity at `centre_`
  struct Composite {
    double mass = 0;
    Vec3 moment = Vec3::Zero();   ///< kg m, about `centre_`
    Mat3 inertia = Mat3::Zero();  ///< about `centre_`
  };
  std::vector<Composite> composites_;
  Vector velocity_, moving_;
  Vector joints_damping_;  ///< N s or N m s in a step, one a joint
  Eigen::MatrixXd inertia_, response_;
};

}  // namespace muro::bullet
