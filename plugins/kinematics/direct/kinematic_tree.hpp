// SPDX-License-Identifier: MIT
// The structure of a robot in the form that forward kinematics uses.
#pragma once

#include <algorithm>
#include <vector>

#include "muro/robot.hpp"
#include "tree_link.hpp"

namespace muro::kinematics {

/// The structure of a robot: `links[i]` is link i + 1 of the robot. Robots of one model share it.
struct KinematicTree {
  std::vector<TreeLink> links;
  bool operator==(const KinematicTree&) const = default;
};

inline KinematicTree kinematic_tree(const muro::Rows<muro::Link>& links) {
  KinematicTree tree;
  std::vector<std::uint32_t> moved_by(links.size(), 0);  // nearest ancestor that a joint moves, or the base
  std::vector<Pose> in_moved(links.size());              // pose in that link's frame, the link's own joint at 0
  for (std::uint32_t i = 1; i < links.size(); ++i) {
    const muro::Link& link = links[i];
    const auto parent = std::size_t(link.parent);
    const Pose pose = in_moved[parent] * link.origin;
    const bool is_fixed = link.joint == JointKind::fixed;
    TreeLink node;
    node.parent = int(moved_by[parent]);
    node.joint = is_fixed                             ? TreeLink::Joint::fixed
                 : link.joint == JointKind::prismatic ? TreeLink::Joint::prismatic
                                                      : TreeLink::Joint::revolute;
    node.is_rotated = pose.orientation.vec() != Vec3::Zero();
    const Vec3 axis = is_fixed ? Vec3::UnitX() : Vec3(pose.orientation * link.axis);
    std::copy_n(pose.position.data(), 3, node.offset);
    std::copy_n(pose.orientation.coeffs().data(), 4, node.rotation);
    std::copy_n(axis.data(), 3, node.axis);
    node.axis_number = axis == Vec3::UnitX() ? 1 : axis == Vec3::UnitY() ? 2 : axis == Vec3::UnitZ() ? 3 : 0;
    tree.links.push_back(node);
    moved_by[i] = is_fixed ? moved_by[parent] : i;
    in_moved[i] = is_fixed ? pose : Pose{};
  }
  return tree;
}

}  // namespace muro::kinematics
