// SPDX-License-Identifier: MIT
// The structure of a robot as direct kinematics sees it.
#pragma once

#include <algorithm>
#include <vector>

#include "link.hpp"
#include "muro/robot.hpp"

namespace muro::kinematics {

/// The structure of a robot: `links[i]` is frame i + 1. Robots of one model share it.
struct Chain {
  std::vector<CarriedLink> links;
  bool operator==(const Chain&) const = default;
};

inline Chain chain_of(std::span<const muro::Link> frames) {
  Chain chain;
  std::vector<std::uint32_t> carrier(frames.size(), 0);  // frame that a joint moves, or the base
  std::vector<Pose> in_carrier(frames.size());           // while the frame's own joint is at 0
  for (std::uint32_t i = 1; i < frames.size(); ++i) {
    const muro::Link& f = frames[i];
    const auto parent = std::size_t(f.parent);
    const Pose placed = in_carrier[parent] * f.origin;
    const bool fixed = f.joint == JointKind::fixed;
    CarriedLink link;
    link.parent = int(carrier[parent]);
    link.joint = fixed                             ? CarriedLink::Joint::fixed
                 : f.joint == JointKind::prismatic ? CarriedLink::Joint::prismatic
                                                   : CarriedLink::Joint::revolute;
    link.turned = placed.orientation.vec() != Vec3::Zero();
    const Vec3 axis = fixed ? Vec3::UnitX() : Vec3(placed.orientation * f.axis);
    std::copy_n(placed.position.data(), 3, link.offset);
    std::copy_n(placed.orientation.coeffs().data(), 4, link.turn);
    std::copy_n(axis.data(), 3, link.axis);
    link.along = axis == Vec3::UnitX() ? 1 : axis == Vec3::UnitY() ? 2 : axis == Vec3::UnitZ() ? 3 : 0;
    chain.links.push_back(link);
    carrier[i] = fixed ? carrier[parent] : i;
    in_carrier[i] = fixed ? placed : Pose{};
  }
  return chain;
}

}  // namespace muro::kinematics
