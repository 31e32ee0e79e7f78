// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include "bullet_robot.hpp"
#include "bullet_settings.hpp"
#include "impulse_cache.hpp"

namespace muro::bullet {

/// Bullet's sequential impulses for articulated bodies, with friction on a cone, and with rows made here.
///
/// Rows are made here, not by btMultiBodyConstraintSolver, for three reasons. BulletRobot::inverse_inertia() gives the
/// effect of an impulse without a pass over all links for each row. Kinematic bodies need no body of Bullet. A rebound
/// gains no speed from the correction of depth.
class BulletSolver final : public btMultiBodyConstraintSolver {
 public:
  explicit BulletSolver(const BulletSettings& settings);

  /// Removes all robots and rows. `dt`: s, length of the step.
  void begin(double dt);
  /// Adds a robot, with rows for its drives and limits. All robots come before contacts.
  void add(BulletRobot& robot, const ImpulseCache& cache);
  /// Adds contacts of two colliders. `a` and `b`: their robots; `b` is null when `other` gives the state of the other
  /// body.
  void add(std::span<SolverContact> contacts, BulletRobot& a, BulletRobot* b, const multibody::BodyState& other);
  /// Solves the rows with split impulses: velocities that separate overlapping bodies do not remain. The first solution
  /// moves positions. Then the rows are solved further without the correction, which gives the velocities.
  void solve();
  /// Gives new velocities and drive efforts to a robot. `number`: its position in the order of adding.
  void finish(BulletRobot& robot, std::size_t number, const ImpulseCache& cache);
  /// Stores the impulses that acted in the contact.
  void finish(SolverContact& contact);

 private:
  struct ConstraintRow {
    btMultiBody *a = nullptr, *b = nullptr;
    int row_a = -1, row_b = -1;         ///< indices in m_data
    double inverse_effective_mass = 0;  ///< 1/kg: change of speed by a unit impulse
    double speed = 0;                   ///< m/s or rad/s, without the row's impulse
  };

  /// Makes the row of a force in `direction` at the point `at`. `other_velocity`: velocity of a body that no row moves.
  ConstraintRow contact_row(const SolverContact& contact, BulletRobot& a, BulletRobot* b, const Vec3& at,
                            const Vec3& other_velocity, const Vec3& direction);
  void add_friction(const SolverContact& contact, BulletRobot& a, BulletRobot* b, const Twist& other_velocity,
                    double friction, const Vec3& initial_impulse);
  void add(SolverContact& contact, const ConstraintRow& normal, double inverse_mass, BulletRobot& a, BulletRobot* b,
           const Twist& other_velocity);
  ConstraintRow turning_row(const SolverContact& contact, BulletRobot& a, BulletRobot* b, const Vec3& other_spin,
                            const Vec3& axis);
  /// Makes the row of a wrench of size 1 on `a` and the opposite wrench on `b`.
  ConstraintRow pair_row(const SolverContact& contact, BulletRobot& a, BulletRobot* b,
                         const BulletRobot::SpatialForce& on_a, const BulletRobot::SpatialForce& on_b);
  void add_resistances(SolverContact& contact, BulletRobot& a, BulletRobot* b, const Vec3& other_spin,
                       const Surface& surface);
  int append(const BulletRobot& robot);
  void find_unit_impulse_response(const BulletRobot& robot, int index, ConstraintRow& row);
  /// Adds a row that reaches the velocity `target` by an impulse between bounds (N s), starting with `initial_impulse`.
  btMultiBodySolverConstraint& add_row(btMultiBodyConstraintArray& rows, const ConstraintRow& row, double target,
                                       double low, double high, double cfm, double initial_impulse);
  void add_joint(BulletRobot& robot, std::size_t number, const ImpulseCache& cache);
  /// Returns the smallest allowed velocity (m/s) away from an obstacle or limit at a distance of `gap` (m).
  double limit_velocity(double gap) const;
  /// Returns the velocity that a contact must reach. `is_active`: whether the contact acts in this step; `is_rebound`:
  /// whether the velocity is a rebound and no correction of an overlap.
  double target_velocity(const SolverContact& contact, double speed, double restitution, bool& is_active,
                         bool& is_rebound) const;

  BulletSettings settings_;
  btContactSolverInfo info_;
  double dt_ = 0;
  struct SplitImpulse {
    int row;     ///< row of a contact
    double rhs;  ///< right-hand side of the row without the correction of the overlap
  };
  std::vector<SplitImpulse> split_impulses_;
  btAlignedObjectArray<btScalar> position_velocity_;  ///< change of velocity that moves positions
  std::vector<int> drive_rows_;                       ///< rows of the drives of all robots; -1: none
  std::vector<int> first_drives_;                     ///< start of each robot in `drive_rows_`
};

}  // namespace muro::bullet
