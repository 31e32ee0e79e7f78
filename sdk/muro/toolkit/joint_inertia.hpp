// SPDX-License-Identifier: MIT
// Inertia that a drive has to move: that of the bodies behind a joint.
#pragma once

#include <vector>

#include "muro/robot.hpp"
#include "muro/toolkit/link_pose.hpp"

namespace muro {

/// The inertia (kg m^2 or kg) that the joint of link `joint` and the mimic joints that follow it move, all other
/// joints and the base held: the element of the joint-space inertia matrix on its diagonal (Featherstone, Rigid Body
/// Dynamics Algorithms, Section 6.2). `inertias`, `positions` (rad or m): one a link. [setup]
inline double joint_inertia(Rows<Link> links, std::span<const Inertia> inertias, std::span<const double> positions,
                            std::size_t joint) {
  std::vector<Pose> in_base(links.size());
  std::vector<Vec3> linear(links.size(), Vec3::Zero()),
      angular = linear;  // at the origin of the link's frame, for q' = 1
  double sum = 0;
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Link& link = links[i];
    const auto parent = std::size_t(link.parent);
    in_base[i] = in_base[parent] * pose_in_parent(link, positions[i]);
    const double rate = i == joint ? 1 : link.mimic == std::int32_t(joint) ? link.mimic_multiplier : 0;
    const Vec3 axis = rate * (in_base[i].orientation * link.axis);
    angular[i] = angular[parent];
    linear[i] = linear[parent] + angular[parent].cross(in_base[i].position - in_base[parent].position);
    if (link.joint == JointKind::revolute) angular[i] += axis;
    if (link.joint == JointKind::prismatic) linear[i] += axis;
    const Vec3 velocity = linear[i] + angular[i].cross(in_base[i].orientation * inertias[i].com);
    const Vec3 spin = in_base[i].orientation.conjugate() * angular[i];
    sum += inertias[i].mass * velocity.squaredNorm() + spin.dot(inertias[i].tensor() * spin);
  }
  return sum;
}

}  // namespace muro
