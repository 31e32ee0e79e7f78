// SPDX-License-Identifier: MIT
// What a drive has to move: the inertia of the bodies behind a joint.
#pragma once

#include <vector>

#include "muro/robot.hpp"
#include "muro/toolkit/link_pose.hpp"

namespace muro {

/// The inertia (kg m^2 or kg) that the joint of frame `joint` and the mimic joints that follow it move, all other
/// joints and the base held: the element of the joint-space inertia matrix on its diagonal (Featherstone, Rigid Body
/// Dynamics Algorithms, Section 6.2). `inertias`, `positions` (rad or m): one a frame. [setup]
inline double joint_inertia(std::span<const Link> frames, std::span<const Inertia> inertias,
                            std::span<const double> positions, std::size_t joint) {
  std::vector<Pose> in_base(frames.size());
  std::vector<Vec3> linear(frames.size(), Vec3::Zero()), angular = linear;  // at the frame's origin, for q' = 1
  double sum = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Link& f = frames[i];
    const auto parent = std::size_t(f.parent);
    in_base[i] = in_base[parent] * pose_in_parent(f, positions[i]);
    const double rate = i == joint ? 1 : f.mimic == std::int32_t(joint) ? f.mimic_multiplier : 0;
    const Vec3 axis = rate * (in_base[i].orientation * f.axis);
    angular[i] = angular[parent];
    linear[i] = linear[parent] + angular[parent].cross(in_base[i].position - in_base[parent].position);
    if (f.joint == JointKind::revolute) angular[i] += axis;
    if (f.joint == JointKind::prismatic) linear[i] += axis;
    const Vec3 velocity = linear[i] + angular[i].cross(in_base[i].orientation * inertias[i].com);
    const Vec3 spin = in_base[i].orientation.conjugate() * angular[i];
    sum += inertias[i].mass * velocity.squaredNorm() + spin.dot(inertias[i].tensor() * spin);
  }
  return sum;
}

}  // namespace muro
