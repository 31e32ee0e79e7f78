// SPDX-License-Identifier: MIT
// Direct kinematics of one robot: from base and joints to all bodies (Featherstone, Rigid Body Dynamics
// Algorithms, Springer 2008, chapter 4), with velocities in world axes at the origins of the bodies' frames.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "muro/robot.hpp"

namespace muro::kinematics {

/// A frame relative to the nearest frame below it that a joint moves (or the base): fixed frames in between are
/// folded in, so a chain of fixed frames costs no more than one, and errors do not add up along it.
struct Link {
  std::uint32_t parent = 0;  ///< frame it is placed from, smaller than its own
  JointKind joint = JointKind::fixed;
  bool turned = false;           ///< `turn` is not the identity
  Vec3 offset = Vec3::Zero();    ///< m, of this frame's origin in the parent's frame, joint at 0
  Quat turn = Quat::Identity();  ///< of this frame in the parent's, joint at 0
  Vec3 axis = Vec3::UnitX();     ///< unit, in the parent's frame

  bool operator==(const Link& b) const {
    return parent == b.parent && joint == b.joint && offset == b.offset && turn.coeffs() == b.turn.coeffs() &&
           axis == b.axis;
  }
};

/// The structure of a robot: `links[i]` is frame i + 1. Robots of one model share it.
struct Chain {
  std::vector<Link> links;
  bool operator==(const Chain&) const = default;
};

inline Chain chain_of(std::span<const Frame> frames) {
  Chain chain;
  std::vector<std::uint32_t> carrier(frames.size(), 0);  // frame that a joint moves, or the base
  std::vector<Pose> in_carrier(frames.size());           // while the frame's own joint is at 0
  for (std::uint32_t i = 1; i < frames.size(); ++i) {
    const Frame& f = frames[i];
    const auto parent = std::size_t(f.parent);
    const Pose placed = in_carrier[parent] * f.origin;
    const bool fixed = f.joint == JointKind::fixed;
    chain.links.push_back({.parent = carrier[parent],
                           .joint = f.joint,
                           .turned = placed.orientation.vec() != Vec3::Zero(),
                           .offset = placed.position,
                           .turn = placed.orientation,
                           .axis = fixed ? Vec3::UnitX() : Vec3(placed.orientation * f.axis)});
    carrier[i] = fixed ? carrier[parent] : i;
    in_carrier[i] = fixed ? placed : Pose{};
  }
  return chain;
}

/// Where the state of a frame lies; joint position (rad or m) and velocity are null for fixed frames.
struct Place {
  Pose* pose = nullptr;
  Twist* twist = nullptr;
  const double* position = nullptr;
  const double* velocity = nullptr;
};

/// Fills in pose and twist of `places[i]`, which is frame i + 1, for every link. `base`, `base_twist`: of frame 0.
inline void place(const Chain& chain, const Pose& base, const Twist& base_twist, const Place* places) {
  // Copies of the parent, since the compiler must assume that what is written lies over what is read.
  Pose from = base;
  Twist moving = base_twist;
  Mat3 axes = from.orientation.toRotationMatrix();
  std::uint32_t parent = 0;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const Link& link = chain.links[i];
    if (link.parent != parent) {  // neighbours mostly share their parent
      parent = link.parent;
      from = parent == 0 ? base : *places[parent - 1].pose;
      moving = parent == 0 ? base_twist : *places[parent - 1].twist;
      axes = from.orientation.toRotationMatrix();
    }
    const Place& at = places[i];  // lazyProduct: without a temporary, which Eigen makes for fear of aliases
    Vec3 arm = axes.lazyProduct(link.offset);
    Quat orientation = from.orientation;
    Vec3 linear = moving.linear, angular = moving.angular;
    if (link.joint == JointKind::revolute) {
      const double half = 0.5 * *at.position, s = std::sin(half);
      orientation = orientation * Quat(std::cos(half), s * link.axis.x(), s * link.axis.y(), s * link.axis.z());
      angular += axes.lazyProduct(link.axis) * *at.velocity;
    } else if (link.joint == JointKind::prismatic) {
      const Vec3 axis = axes.lazyProduct(link.axis);
      arm += axis * *at.position;
      linear += axis * *at.velocity;
    }
    if (link.turned) orientation = orientation * link.turn;
    linear += moving.angular.cross(arm);
    *at.pose = {from.position + arm, orientation};
    *at.twist = {linear, angular};
  }
}

}  // namespace muro::kinematics
