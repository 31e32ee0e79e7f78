// SPDX-License-Identifier: MIT
// The dynamics of a robot's joints: their inertias, and the forces along them.
#pragma once

#include <span>
#include <vector>

#include "muro/handles.hpp"
#include "muro/robot.hpp"
#include "plugins/motion/common/position_drive/moved_inertias.hpp"

namespace muro::simplified {

/// The dynamics of each joint of a robot, as if all other joints were locked.
///
/// A joint and the mimic joints that follow it are one degree of freedom. The bodies that it moves have the kinetic
/// energy M q'^2 / 2 (composite rigid bodies: Featherstone, Rigid Body Dynamics Algorithms, Section 6.2, the diagonal
/// of the joint-space inertia matrix). The generalized force Q is the power of all forces on these bodies for q' = 1:
/// wrenches, gravity, and inertial forces in the frame of the base, which is accelerated by the sum of wrenches. A free
/// base yields to a joint so that the robot's centre of mass does not move: M loses P^2 / m, where P is the momentum
/// for q' = 1. The angular part is omitted: a swinging arm does not turn the trunk. Velocity terms between joints and
/// off-diagonal inertias are omitted.
class DecoupledDynamics {
 public:
  /// State of one degree of freedom.
  struct Dof {
    std::uint32_t link = 0;  ///< link of its joint
    double inertia = 0;      ///< kg m^2 or kg
    double force = 0;        ///< N m or N: all forces except the drive, friction and damping of the joint
  };
  /// `inertias`: one per link. `dofs`: links of the joints that are degrees of freedom, no mimic joints. `armature`: kg
  /// m^2 or kg, added by driven() to the armature in the joints' limits.
  DecoupledDynamics(Rows<Link> links, std::span<const Inertia> inertias, std::span<const std::uint32_t> dofs,
                    bool fixed_base, double armature = 0);

  void add_wrench(std::uint32_t link, SumIn<Wrench> wrench);

  /// Fills `dofs` and returns the sum of all wrenches as one wrench on the base. `pose`, `twist`: of the base;
  /// `positions` (rad or m): one per link, 0 for fixed joints; `gravity` in world axes. Does not allocate.
  Wrench update(const Pose& pose, const Twist& twist, std::span<const double> positions, const Vec3& gravity);
  std::span<const Dof> dofs() const { return dofs_; }

  /// kg m^2 or kg: inertia that a drive of degree of freedom `k` moves, with the bodies as update() has placed them.
  /// See MovedInertias.
  double driven(std::size_t k) const { return tree_.driven(body_of_link_[dofs_[k].link]); }

 private:
  using Vector = lane::V3<double>;
  using Matrix = lane::M3<double>;

  /// Links that fixed joints hold together, with the joint that moves them. Vectors are in axes of the base.
  struct Body {
    std::int32_t parent = -1;
    std::uint32_t link = 0;  ///< the first link
    JointKind joint = JointKind::fixed;
    bool has_constant_inertia = false;  ///< no joint moves its masses: the base, or a wheel on it
    double mass = 0;                    ///< kg
    Vector force{}, torque{};           ///< all forces on it and, when summed, on bodies behind it; about the origin
    Vector linear{}, angular{};         ///< at its origin, for q' = 1 of the present joint
  };
  /// A body that a degree of freedom moves.
  struct MovedBody {
    std::uint32_t body = 0;
    std::int32_t carrier = -1;  ///< parent body, if that one moves, too
    double rate = 0;            ///< rate of its own joint for q' = 1
  };
  struct AppliedWrench {
    std::uint32_t body = 0;
    Vector origin{};  ///< m, in the body's frame
    SumIn<Wrench> wrench;
  };

  std::vector<MovedInertias::Body> join(Rows<Link> links, std::span<const Inertia> inertias);
  void find_constant_inertias(std::span<const MovedInertias::Body> tree);
  void find_places(std::span<const double> positions);
  void add_inertial_forces(const Vector& force, const Vector& torque, const Vector& spin, const Vector& gravity);
  void sum_forces();
  void project_onto(Dof& dof) const;
  void project_onto(Dof& dof, std::span<const MovedBody> moved);

  bool fixed_base_;
  double mass_ = 0;
  bool all_constant_ = true;     ///< all bodies have constant inertia
  Vector centre_{};              ///< m, centre of mass of all bodies
  Matrix tensor_{}, inverse_{};  ///< kg m^2, of all bodies, about centre_; the inverse for a free base
  MovedInertias tree_;
  std::vector<double> positions_;  ///< rad or m: of the joint of each body
  std::vector<Body> bodies_;
  std::vector<std::uint32_t> body_of_link_;
  std::vector<Pose> pose_in_body_;  ///< one per link
  std::vector<Dof> dofs_;
  std::vector<std::vector<MovedBody>> moved_;  ///< by degree of freedom; empty: only its joint moves
  std::vector<AppliedWrench> wrenches_;
};

}  // namespace muro::simplified
