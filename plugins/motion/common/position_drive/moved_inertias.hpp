// SPDX-License-Identifier: MIT
// The inertias that the joints of a robot move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body_frame.hpp"

namespace muro {

/// Of each joint, as if all others were locked: of what hangs on it (the diagonal of the joint-space inertia matrix:
/// Featherstone, Rigid Body Dynamics Algorithms, 6.2), and of the rest of the robot, which a free base lets move.
class MovedInertias {
 public:
  using Vector = lane::V3<double>;
  using Matrix = lane::M3<double>;

  /// A link, or several that are one body, with the joint that leads to it.
  struct Body {
    Link link;        ///< `parent`: number of a body that comes before it; -1: this is the base
    Inertia inertia;  ///< in the body's frame
  };
  MovedInertias() = default;
  MovedInertias(std::span<const Body> bodies, bool fixed_base);

  /// `positions`: of the joint of each body, rad or m. Does not allocate.
  void update(std::span<const double> positions);

  /// Where a body is; in the frame of the base.
  struct Placed {
    BodyFrame frame;
    Vector axis{};    ///< unit, of its joint, which the origin of its frame is on
    Vector centre{};  ///< m, of mass
    Matrix tensor{};  ///< kg m^2, about the centre
  };
  const Placed& placed(std::size_t body) const { return bodies_[body].placed; }

  /// A body with all that hangs on it.
  struct Composite {
    double mass = 0;
    Vector first_moment{};   ///< kg m, about the base's origin
    Matrix second_moment{};  ///< kg m^2, tensor of inertia about the base's origin
  };
  const Composite& composite(std::size_t body) const { return bodies_[body].composite; }

  /// kg m^2 or kg: of what hangs on a joint.
  double behind(std::size_t body) const { return along(body, composite(body)); }
  /// kg m^2 or kg: the larger one, with the armature. A foot on the ground does not move: its joint moves the robot.
  double driven(std::size_t body) const;
  /// kg m^2 or kg: of the joint in free motion, by both sides together, with the armature.
  double free(std::size_t body) const;

 private:
  /// About, or along, the axis of the joint of a body.
  double along(std::size_t body, const Composite& composite) const;
  /// All but what hangs on a joint.
  double before(std::size_t body) const;

  struct TreeBody {
    std::int32_t parent = -1;
    JointFrame joint;
    double armature = 0;  ///< kg m^2 or kg
    double mass = 0;      ///< kg
    Vector com{};         ///< m, in the body's frame
    Matrix tensor{};      ///< kg m^2, the same
    Placed placed;
    Composite composite;
  };
  bool fixed_base_ = true;
  std::vector<TreeBody> bodies_;
};

}  // namespace muro
