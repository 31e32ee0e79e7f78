// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include "bullet_robot.hpp"
#include "bullet_settings.hpp"
#include "impulse_cache.hpp"

namespace muro::bullet {

/// Bullet's sequential impulses for articulated bodies, with friction on a cone, for rows of our own.
///
/// Rows are made here, not by btMultiBodyConstraintSolver, so that an impulse's effect is read from
/// BulletRobot::inverse_inertia() instead of being found by a pass over all links for each row, kinematic bodies need
/// no body of Bullet, and a rebound gains no speed from the depth that is taken back.
class BulletSolver final : public btMultiBodyConstraintSolver {
 public:
  explicit BulletSolver(const BulletSettings& settings);

  /// Begins with no robots and no rows; steps are `dt` (s) long.
  void begin(double dt);
  /// Robots come first. Adds rows for its drives and limits.
  void add(BulletRobot& robot, const ImpulseCache& cache);
  /// Contacts of two colliders. `a` and `b`: their robots; no `b` where the state of the other body is given.
  void add(std::span<SolverContact> contacts, BulletRobot& a, BulletRobot* b, const multibody::BodyState& other);
  /// By split impulses: velocities that move bodies apart that overlap do not last. What is found first moves
  /// positions, then the rows are solved on without it, and velocities are what is left.
  void solve();
  /// Gives the robot, the `number`th that was added, its new velocities, and its drives' efforts to its joints.
  void finish(BulletRobot& robot, std::size_t number, const ImpulseCache& cache);
  /// Puts what acted into SolverContact::impulse.
  void finish(SolverContact& contact);

 private:
  struct ConstraintRow {
    btMultiBody *a = nullptr, *b = nullptr;
    int row_a = -1, row_b = -1;         ///< in m_data
    double inverse_effective_mass = 0;  ///< 1/kg: change of speed by a unit impulse
    double speed = 0;                   ///< m/s, rad/s: without it
  };

  /// Of a force in `direction` at the point `at`, where what no row moves has the velocity `other_velocity`.
  ConstraintRow contact_row(const SolverContact& contact, BulletRobot& a, BulletRobot* b, const Vec3& at,
                            const Vec3& other_velocity, const Vec3& direction);
  void add_friction(const SolverContact& contact, BulletRobot& a, BulletRobot* b, const Twist& other_velocity,
                    double friction, const Vec3& initial_impulse);
  void add(SolverContact& contact, const ConstraintRow& normal, double inverse_mass, BulletRobot& a, BulletRobot* b,
           const Twist& other_velocity);
  ConstraintRow turning_row(const SolverContact& contact, BulletRobot& a, BulletRobot* b, const Vec3& other_spin,
                            const Vec3& axis);
  /// Of what a wrench of size 1 on `a`, and its opposite on `b`, does.
  ConstraintRow pair_row(const SolverContact& contact, BulletRobot& a, BulletRobot* b,
                         const BulletRobot::SpatialForce& on_a, const BulletRobot::SpatialForce& on_b);
  void add_resistances(SolverContact& contact, BulletRobot& a, BulletRobot* b, const Vec3& other_spin,
                       const Surface& surface);
  int append(const BulletRobot& robot);
  void find_unit_impulse_response(const BulletRobot& robot, int index, ConstraintRow& row);
  /// Makes the velocity `target` by an impulse between bounds (N s), beginning with `initial_impulse`.
  btMultiBodySolverConstraint& add_row(btMultiBodyConstraintArray& rows, const ConstraintRow& row, double target,
                                       double low, double high, double cfm, double initial_impulse);
  void add_joint(BulletRobot& robot, std::size_t number, const ImpulseCache& cache);
  /// The smallest velocity (m/s) away from what is `gap` (m) away.
  double limit_velocity(double gap) const;
  /// `is_active`: whether the contact acts in this step; `is_rebound`: whether the velocity lasts, being no correction
  /// of an overlap.
  double target_velocity(const SolverContact& contact, double speed, double restitution, bool& is_active,
                         bool& is_rebound) const;

  BulletSettings settings_;
  btContactSolverInfo info_;
  double dt_ = 0;
  struct SplitImpulse {
    int row;     ///< of a contact
    double rhs;  ///< of this row, without the velocity that corrects the overlap
  };
  std::vector<SplitImpulse> split_impulses_;
  btAlignedObjectArray<btScalar> position_velocity_;  ///< change of velocity that moves positions
  std::vector<int> drive_rows_;                       ///< of the joints of all robots; -1: none
  std::vector<int> first_drives_;                     ///< in `drive_rows_`, of each robot
};

}  // namespace muro::bullet
