// SPDX-License-Identifier: MIT
// What acts on the joints of a robot: their inertias, and the forces along them.
#pragma once

#include <span>
#include <vector>

#include "muro/handles.hpp"
#include "muro/robot.hpp"

namespace muro::simplified {

/// The links of a robot as joints feel them, each joint as if all others stood still.
///
/// A joint and the mimic joints that follow it are one degree of freedom. It has the kinetic energy M q'^2 / 2 of all
/// bodies that it moves (composite rigid bodies: Featherstone, Rigid Body Dynamics Algorithms, Section 6.2, the
/// diagonal of the joint-space inertia matrix), and the generalized force Q: the power of all that acts on these
/// bodies, for q' = 1. That is wrenches, gravity, and the inertia of the bodies in the base's frame, which the sum of
/// wrenches accelerates. A free base gives way to a joint as far as its centre of mass does not move: M loses P^2 / m,
/// with P the momentum for q' = 1 (the angular part is left out: a swinging arm does not turn the trunk). Velocity
/// terms between joints and off-diagonal inertias are left out.
class Linkage {
 public:
  /// Of one degree of freedom.
  struct Dof {
    std::uint32_t frame = 0;  ///< of its joint
    double inertia = 0;       ///< kg m^2 or kg
    double force = 0;         ///< N m or N: all but the drive and what the joint itself holds back
  };
  /// Where a wrench acts on the robot.
  struct Touch {
    std::uint32_t frame = 0;
    SumIn<Wrench> wrench;
  };

  /// `inertias`: one a frame. `dofs`: frames of joints, none of them a mimic.
  Linkage(std::span<const Link> frames, std::span<const Inertia> inertias, std::span<const std::uint32_t> dofs,
          bool fixed_base);

  void add_touch(std::uint32_t frame, SumIn<Wrench> wrench);

  /// `pose`, `twist`: of the base; `positions` (rad or m): one a frame, 0 for fixed joints; `gravity` in world axes.
  /// Fills `dofs` and returns the sum of all wrenches, as one on the base. Does not allocate.
  Wrench update(const Pose& pose, const Twist& twist, std::span<const double> positions, const Vec3& gravity);
  std::span<const Dof> dofs() const { return dofs_; }

 private:
  /// The bodies that move as one behind a joint. Vectors in axes of the base, from its origin.
  struct RigidGroup {
    std::int32_t parent = -1;
    std::uint32_t frame = 0;
    Link joint;          ///< `origin` in the frame of the parent link
    Inertia inertia;     ///< in the link's frame
    bool still = false;  ///< no joint moves its masses: it is the base, or a wheel on it
    Pose in_base;
    Vec3 axis = Vec3::Zero(), centre = Vec3::Zero();
    Mat3 tensor = Mat3::Zero();                          ///< about the centre
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();    ///< all that acts, about the centre
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  ///< at its origin, for q' = 1 of the joint at hand
  };
  /// A link that a degree of freedom moves.
  struct Moved {
    std::uint32_t link = 0;
    std::int32_t carrier = -1;  ///< link that it hangs on, if that one moves, too
    double rate = 0;            ///< of its own joint for q' = 1
  };
  struct Place {
    std::uint32_t link = 0;
    Vec3 origin = Vec3::Zero();  ///< m, in the link's frame
    SumIn<Wrench> wrench;
  };

  void find_still_links();
  void place(RigidGroup& link, double position);
  void weigh();
  void add_motion_of_base(const Vec3& force, const Vec3& torque, const Vec3& spin, const Vec3& gravity);
  void sum_up(Dof& dof, std::span<const Moved> moved);

  bool fixed_base_;
  double mass_ = 0;
  bool still_ = true;            ///< all links are
  Vec3 centre_ = Vec3::Zero();   ///< m, of mass of all links
  Mat3 tensor_ = Mat3::Zero();   ///< kg m^2, of all links, about centre_
  Mat3 inverse_ = Mat3::Zero();  ///< of tensor_; for a free base
  std::vector<RigidGroup> links_;
  std::vector<std::uint32_t> link_of_;  ///< by frame
  std::vector<Pose> in_link_;           ///< of each frame
  std::vector<Dof> dofs_;
  std::vector<std::vector<Moved>> moved_;  ///< by degree of freedom
  std::vector<Place> places_;
};

}  // namespace muro::simplified
