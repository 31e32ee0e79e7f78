// SPDX-License-Identifier: MIT
// The kernels of forward kinematics. They compute pose and twist of every link from those of the base and the joints
// (Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, chapter 4). Velocities are in world axes at the origins
// of the links' frames.
#pragma once

#include <cstddef>

#include "muro/simd/isa.hpp"

namespace muro::kinematics {

/// A link relative to its nearest ancestor that a joint moves, or to the base. Fixed joints in between are included in
/// `offset` and `rotation`, so that a chain of fixed joints costs no more than one, and errors do not add up along it.
struct TreeLink {
  enum class Joint { fixed, revolute, prismatic };
  int parent = 0;  ///< this ancestor; its index is smaller than that of the link
  Joint joint = Joint::fixed;
  bool is_rotated = false;            ///< whether `rotation` is not the identity
  double offset[3] = {0, 0, 0};       ///< m, of this link's origin in the parent's frame, joint at 0
  double rotation[4] = {0, 0, 0, 1};  ///< quaternion x y z w of this link in the parent's frame, joint at 0
  double axis[3] = {1, 0, 0};         ///< unit, in the parent's frame
  int axis_number = 1;                ///< 1, 2, 3: the axis is the x, y, z axis of the parent's frame; 0: none of them

  friend bool operator==(const TreeLink&, const TreeLink&) = default;
};

/// Places of the state of a link: offsets, in numbers, from the state of the robot's first link (see RobotState).
struct StateOffsets {
  std::ptrdiff_t pose = 0, twist = 0;
  std::ptrdiff_t position = 0, velocity = 0;  ///< state of its joint

  friend bool operator==(const StateOffsets&, const StateOffsets&) = default;
};

/// Addresses of the state of a robot: pose (position x y z, orientation x y z w) and twist (linear, angular) of the
/// base and of the first link; position (rad or m) and velocity of the first joint.
struct RobotState {
  const double* base_pose = nullptr;
  const double* base_twist = nullptr;
  double* poses = nullptr;
  double* twists = nullptr;
  const double* positions = nullptr;
  const double* velocities = nullptr;
};

struct Kernels {
  /// Computes pose and twist of all links of up to eight robots with the same links and offsets. Each robot gets the
  /// same bits as alone.
  void (*forward_kinematics)(const TreeLink* links, const StateOffsets* offsets, int link_count,
                             const RobotState* robots, int robot_count);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::kinematics
