// SPDX-License-Identifier: MIT
// Contacts of bodies that carry each other, solved together: the forces that springs, dampers and friction have at the
// end of the step, when all of them act.
//
// A single contact does not know what lies on its body or what holds it from below. So a spring that is right for its
// two bodies is too soft for what they carry. Here the velocities v of all bodies at the end of the step follow from
//
//     M (v - v0) = h J' f(J v),   f = push - K J v where a contact pushes, within Coulomb's cone
//
// with v0 the velocities without contacts, J v the relative velocities in the contacts, K = damping + h stiffness: the
// implicit Euler method, which gains no energy however stiff a contact is. So stiffness follows from the weight of all
// connected bodies. Newton's method with a line search finds which contacts push and how much friction holds, as in
// Todorov, Convex and analytically-invertible dynamics with contacts and constraints, ICRA 2014: with given limits of
// friction, the velocities are at the minimum of a convex function. The limits are those of the loads found. They are
// updated after each Newton step, all together, by the secant method (Anderson, Iterative procedures for nonlinear
// integral equations, J. ACM 12, 1965, with one step of memory). If that does not settle, they are only updated after
// velocities have been found for them.
#pragma once

#include "block_system.hpp"
#include "bodies.hpp"

namespace muro::penalty {

/// A contact of a group of bodies. Forces act on the own body; the other gets the opposite.
struct SolverContact {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t body = none, other = none;                ///< numbers in the group; none: no force moves it
  std::uint32_t coupling = none;                          ///< coupling of both bodies
  Vec3 normal = Vec3::UnitZ();                            ///< unit, into the own body
  Vec3 lever = Vec3::Zero(), other_lever = Vec3::Zero();  ///< m, from the centres of mass
  Vec3 cell = Vec3::Zero();                               ///< m, from the point to the place where friction acts
  Vec3 touched = Vec3::Zero();                            ///< m/s: velocity of a body that no force moves, at the point
  /// Whether friction moves the bodies in this step. Otherwise their velocity across the normal does not change, as
  /// that of links that joints hold: see hold().
  bool moves_body = true, moves_other = true;
  /// Whether its friction has a part in the solution.
  bool has_friction_in_it() const { return moves_body || (other != none && moves_other); }
  double push = 0;               ///< N, along the normal: force of the spring at the start of the step
  double along = 0, across = 0;  ///< N s/m: K along the normal and across
  Vec3 spring = Vec3::Zero();    ///< N, across: force of the friction spring at the start of the step
  double friction = 0;           ///< coefficient
  double limit = 0;              ///< N: expected limit of friction; 0 if nothing is known
  bool only_damps = false;       ///< it only holds the body against motion, and gives no force

  // results
  bool pushes = true;
  double hold = 1;                            ///< ratio of friction to its value without a limit
  double load = 0;                            ///< N, along the normal
  double limit_before = -1, limit_found = 0;  ///< N: the limit before `limit`, and the limit found with it; -1: none
  Vec3 velocity = Vec3::Zero(), way = Vec3::Zero();  ///< m/s: of the point so far, and from it to the solution
  Mat3 yields = Mat3::Zero();   ///< N s/(m/s): decrease of its impulse with velocity, in the last system
  Vec3 impulse = Vec3::Zero();  ///< N s: its impulse at velocity 0, in the last linear system
  double away = 0;              ///< m/s: speed at which the points part at the end of the step
  Vec3 force = Vec3::Zero();    ///< N: the whole force
};

class ContactSolver {
 public:
  /// Starts a group.
  void start(double step);
  /// Adds a body and returns its number. `velocity` (m/s, of the centre of mass) and `spin` (rad/s): present values;
  /// `gained`, `turned`: their changes in the step without contacts.
  std::uint32_t add_body(const law::Mobility<double>& mobility, const Vec3& velocity, const Vec3& spin,
                         const Vec3& gained, const Vec3& turned);
  SolverContact& add_contact() { return contacts_.emplace_back(); }
  /// Marks the bodies of the last contact that friction does not move: the own, the other. Call it when its bodies,
  /// levers, cell, normal and `touched` are set.
  void hold(bool body, bool other);
  /// Finds the forces of all contacts, in the order in which they were added.
  std::span<const SolverContact> solve();

 private:
  struct Body {
    BlockSystem::Block mass;
    BlockSystem::Vector momentum;  ///< momentum at the end of the step without contacts
  };
  static Vec3 velocity_in(const SolverContact& c, const std::vector<BlockSystem::Vector>& velocities);
  void add_terms(SolverContact& c);
  void add_damper(const SolverContact& c, const Mat3& k, const Vec3& impulse, const Vec3& arm, bool moves_body,
                  bool moves_other);
  void assemble();
  /// Reaction (N) of the contact without its limits: `load` along the normal and `drag` across it, against the force.
  struct Reaction {
    double load;
    Vec3 drag;
  };
  static Reaction reaction_at(const SolverContact& c, const Vec3& velocity);
  static bool differs(const SolverContact& c, const Reaction& r, double hold);
  bool is_solution() const;
  static bool revise(SolverContact& c);
  bool find_velocities(int most_iterations, int& left);
  bool revise_limits(double part);
  double part_of_last_change() const;
  double slope_at(double part) const;
  bool approach_solution();
  void find_force(SolverContact& c) const;

  double step_ = 0;
  std::vector<Body> bodies_;
  std::vector<SolverContact> contacts_;
  std::vector<BlockSystem::Vector> velocities_, solution_, right_;
  BlockSystem system_;
};

}  // namespace muro::penalty
