// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include "settings.hpp"
#include "touch.hpp"

namespace muro::bullet {

/// Bullet's sequential impulses for articulated bodies, with friction on a cone, for rows of our own.
///
/// Rows are made here, not by btMultiBodyConstraintSolver, so that an impulse's effect is read from Robot::response()
/// instead of being found by a pass over all links for each row, obstacles need no body of Bullet, and a rebound gains
/// no speed from the depth that is taken back.
class Solver final : public btMultiBodyConstraintSolver {
 public:
  explicit Solver(const Settings& settings);

  /// Begins with no robots and no rows; steps are `dt` (s) long.
  void begin(double dt);
  /// Robots come first. Adds rows for its drives and limits.
  void add(Robot& robot, const Memory& memory);
  /// `a` and `b`: robots of the two colliders; no `b` when the other's velocity at the point, `moving` (m/s), is given.
  void add(Touch& touch, Robot& a, Robot* b, const Vec3& moving);
  /// Bodies that overlap are moved apart by speeds that do not last: what is found first moves positions, then the
  /// rows are solved on without it, and velocities are what is left.
  void solve();
  /// Gives the robot, the `number`th that was added, its new velocities, and its drives' efforts to its joints.
  void finish(Robot& robot, std::size_t number, const Memory& memory);
  /// Puts what acted into Touch::impulse.
  void finish(Touch& touch);

 private:
  struct Row {
    btMultiBody *a = nullptr, *b = nullptr;
    int row_a = -1, row_b = -1;  ///< in m_data
    double answer = 0;           ///< 1/kg: change of speed by a unit impulse
    double speed = 0;            ///< m/s, rad/s: without it
  };

  Row contact_row(const Touch& touch, Robot& a, Robot* b, const Vec3& moving, const Vec3& direction);
  int append(const Robot& robot);
  void answer(const Robot& robot, int index, Row& row);
  /// Makes the speed `target` by an impulse between bounds (N s), beginning with `start`.
  btMultiBodySolverConstraint& put(btMultiBodyConstraintArray& rows, const Row& row, double target, double low,
                                   double high, double cfm, double start);
  void add_joint(Robot& robot, std::size_t part, const Memory& memory);
  /// Least speed (m/s) away from what is `gap` (m) away.
  double stop(double gap) const;
  /// `lasts`: whether the speed is more than a way to part the bodies.
  double target(const Touch& touch, double speed, double restitution, bool& matters, bool& lasts) const;

  Settings settings_;
  btContactSolverInfo info_;
  double dt_ = 0;
  struct Parting {
    int row;     ///< of a contact
    double rhs;  ///< of this row, without the speed of parting
  };
  std::vector<Parting> partings_;
  btAlignedObjectArray<btScalar> moving_;  ///< change of velocity that moves positions
  std::vector<int> drive_rows_;            ///< of the joints of all robots; -1: none
  std::vector<int> first_drives_;          ///< in `drive_rows_`, of each robot
};

}  // namespace muro::bullet
