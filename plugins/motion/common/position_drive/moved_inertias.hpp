// SPDX-License-Identifier: MIT
// The inertias that the joints of a robot move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body_frame.hpp"

namespace muro {

/// Inertias that each joint moves, as if all other joints were locked: the inertia of the bodies behind it (the
/// diagonal of the joint-space inertia matrix: Featherstone, Rigid Body Dynamics Algorithms, 6.2), and of the rest of
/// the robot, which moves when the base is free.
class MovedInertias {
 public:
  using Vector = lane::V3<double>;
  using Matrix = lane::M3<double>;

  /// A link, or several links that are one body, with the joint that moves it.
  struct Body {
    Link link;        ///< `parent`: number of a body that comes before it; -1: this is the base
    Inertia inertia;  ///< in the body's frame
  };
  MovedInertias() = default;
  MovedInertias(std::span<const Body> bodies, bool fixed_base);

  /// Finds all inertias. `positions`: position of each body's joint, rad or m. Does not allocate.
  void update(std::span<const double> positions);

  /// The place of a body in the frame of the base.
  struct Placed {
    BodyFrame frame;
    Vector axis{};    ///< unit: axis of its joint, through the origin of its frame
    Vector centre{};  ///< m, centre of mass
    Matrix tensor{};  ///< kg m^2, about the centre
  };
  const Placed& placed(std::size_t body) const { return bodies_[body].placed; }

  /// A body with all bodies behind it.
  struct Composite {
    double mass = 0;
    Vector first_moment{};   ///< kg m, about the base's origin
    Matrix second_moment{};  ///< kg m^2, tensor of inertia about the base's origin
  };
  const Composite& composite(std::size_t body) const { return bodies_[body].composite; }

  /// kg m^2 or kg: inertia of all bodies behind a joint.
  double behind(std::size_t body) const { return along(body, composite(body)); }
  /// kg m^2 or kg: the larger of both sides, with the armature. A foot on the ground does not move: its joint moves the
  /// robot.
  double driven(std::size_t body) const;
  /// kg m^2 or kg: inertia of the joint in free motion, from both sides together, with the armature.
  double free(std::size_t body) const;

 private:
  /// Inertia about (or along) the axis of a body's joint.
  double along(std::size_t body, const Composite& composite) const;
  /// Inertia of all bodies that are not behind a joint.
  double before(std::size_t body) const;

  struct TreeBody {
    std::int32_t parent = -1;
    JointFrame joint;
    double armature = 0;  ///< kg m^2 or kg
    double mass = 0;      ///< kg
    Vector com{};         ///< m, in the body's frame
    Matrix tensor{};      ///< kg m^2, in the body's frame
    Placed placed;
    Composite composite;
  };
  bool fixed_base_ = true;
  std::vector<TreeBody> bodies_;
};

}  // namespace muro
