// SPDX-License-Identifier: MIT
// The inertias that the joints of a robot move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "muro/robot.hpp"

namespace muro {

/// Of each joint, as if all others were locked: of what hangs on it (the diagonal of the joint-space inertia matrix:
/// Featherstone, Rigid Body Dynamics Algorithms, 6.2), and of the rest of the robot, which a free base lets move.
class MovedInertias {
 public:
  /// A link, or several that are one body, with the joint that leads to it.
  struct Body {
    Link link;        ///< `parent`: number of a body that comes before it; -1: this is the base
    Inertia inertia;  ///< in the body's frame
  };
  MovedInertias() = default;
  MovedInertias(std::vector<Body> bodies, bool fixed_base);

  /// `positions`: of the joint of each body, rad or m. Does not allocate.
  void update(std::span<const double> positions);

  /// Where a body is; in the frame of the base.
  struct Placed {
    Vec3 joint = Vec3::Zero();   ///< m, a point on its joint's axis
    Vec3 axis = Vec3::Zero();    ///< unit
    Vec3 centre = Vec3::Zero();  ///< m, of mass
    Mat3 tensor = Mat3::Zero();  ///< kg m^2, about the centre
  };
  /// The same for who knows already where all bodies are: place() each of them, then find().
  void place(std::size_t body, const Placed& placed);
  void find();

  /// kg m^2 or kg: the larger one, with the armature. A foot on the ground does not move: its joint moves the robot.
  double driven(std::size_t body) const { return moved_[body].driven; }
  /// kg m^2 or kg: of the joint in free motion, by both sides together, with the armature.
  double free(std::size_t body) const { return moved_[body].free; }

 private:
  struct Composite {
    double mass = 0;
    Vec3 first_moment = Vec3::Zero();   ///< kg m, about the base's origin
    Mat3 second_moment = Mat3::Zero();  ///< kg m^2, tensor of inertia about the base's origin
    Composite without(const Composite& part) const;
    /// About, or along, the axis of a joint.
    double along(JointKind kind, const Placed& placed) const;
  };
  struct Moved {
    double driven = 0, free = 0;
  };

  bool fixed_base_ = true;
  std::vector<Body> bodies_;
  std::vector<Pose> poses_;  ///< in the frame of the base
  std::vector<Placed> placed_;
  std::vector<Composite> composites_;
  std::vector<Moved> moved_;
};

}  // namespace muro
