// SPDX-License-Identifier: MIT
// Centre of mass and inertia of a robot with moving joints.
#pragma once

#include <span>
#include <vector>

#include "plugins/motion/common/position_drive/body_frame.hpp"

namespace muro::simplified {

/// The whole robot as one body, in the frame of its base.
struct MassState {
  Vec3 com = Vec3::Zero();           ///< m
  Vec3 com_velocity = Vec3::Zero();  ///< m/s, relative to the base: velocity of the centre by the joints
  Mat3 tensor = Mat3::Zero();        ///< kg m^2, about the centre
};

/// Whether turning about `axis` (unit, through the origin of its frame) does not change the centre of mass and the
/// inertia of a body. Models give both with few digits, so the margins are 1 um and 1e-6 of the inertia.
bool balanced(const Inertia& body, const Vec3& axis);

/// The links of a robot as one composite body, joined to as few rigid groups as its moving masses allow.
///
/// A joint opens no group when the subtree's centre of mass lies on its axis and the inertia is symmetric about it (a
/// wheel): turning it changes nothing. A vehicle is one group.
class CompositeBody {
 public:
  /// `inertias`: one per link; `start`: joint positions (rad or m) at the start, one per link. Positions of joints that
  /// open no group are not needed later.
  CompositeBody(Rows<Link> links, std::span<const Inertia> inertias, std::span<const double> start);

  double mass() const { return mass_; }
  /// Whether no joint changes centre or inertia.
  bool rigid() const { return groups_.size() == 1; }
  /// Returns the links whose joint moves mass, in the order that `state` needs.
  std::span<const std::uint32_t> joints() const { return joints_; }
  /// Computes the mass state. `positions`, `velocities`: of `joints()`. Does not allocate.
  MassState state(std::span<const double> positions, std::span<const double> velocities);

 private:
  struct Group {
    std::uint32_t parent = 0;  ///< always smaller than its own number
    JointFrame joint;
    double mass = 0;            ///< kg
    lane::V3<double> com{};     ///< m, in the group's frame
    lane::M3<double> tensor{};  ///< kg m^2, in the group's frame, about the centre
    BodyFrame in_base;
    lane::TwistOf<double> motion{};  ///< relative to the base, in its axes, at the group's origin
  };
  double mass_ = 0;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> joints_;
};

}  // namespace muro::simplified
