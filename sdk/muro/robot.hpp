// SPDX-License-Identifier: MIT
// A robot: a compound with a tree-shaped structure (MuRoSimF, Section 2.1), and its flattened form.
#pragma once

#include <limits>
#include <string_view>

#include "muro/object.hpp"
#include "muro/rows.hpp"

namespace muro {

/// The blocks a robot's tree is made of. Only binary forks exist.
enum class NodeKind : std::uint8_t { base, fork, translation, rotation, revolute, prismatic, body };

struct JointLimits {
  double lower = -std::numeric_limits<double>::infinity();    ///< rad or m
  double upper = std::numeric_limits<double>::infinity();     ///< rad or m
  double velocity = std::numeric_limits<double>::infinity();  ///< rad/s or m/s
  double effort = std::numeric_limits<double>::infinity();    ///< N m or N
  double damping = 0;                                         ///< N m s/rad or N s/m
  double friction = 0;                                        ///< N m or N
  double armature = 0;  ///< kg m^2 or kg: inertia of the drive's rotor at the joint (MuJoCo)
};

enum class JointKind : std::uint8_t { fixed, revolute, prismatic };

/// One rigid body of the flattened tree with the joint that leads to it. `origin` includes fixed translations,
/// rotations and forks. May grow at its end.
struct Link {
  ObjectId object = no_object;  ///< holds pose, twist, inertial, shapes
  std::int32_t parent = -1;     ///< index of the parent link, always smaller than its own; -1: it is the base
  JointKind joint = JointKind::fixed;
  ObjectId joint_object = no_object;  ///< holds joint.position and so on; no_object: a fixed joint
  Pose origin;                        ///< of this link's frame in its parent's with the joint at 0
  Vec3 axis = Vec3::UnitX();          ///< unit, in this link's frame
  JointLimits limits;
  std::int32_t mimic = -1;  ///< index of the link whose joint this one follows: q = offset + multiplier * q_mimic
  double mimic_multiplier = 1;
  double mimic_offset = 0;
};

/// A robot as algorithms see it. Link 0 is the base; children follow their parents, depth first. May grow at its end.
struct RobotView {
  std::string_view name;
  RobotId id = no_robot;
  std::uint64_t key = 0;  ///< from the name alone: keys random numbers
  Rows<Link> links;

  ObjectId base() const { return links.front().object; }
};

}  // namespace muro
