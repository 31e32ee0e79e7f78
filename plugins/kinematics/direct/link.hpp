// SPDX-License-Identifier: MIT
// Kernels: pose and twist of every body from those of the base and the joints (Featherstone, Rigid Body Dynamics
// Algorithms, Springer 2008, chapter 4), with velocities in world axes at the origins of the bodies' frames.
#pragma once

#include <cstddef>

#include "muro/simd/isa.hpp"

namespace muro::kinematics {

/// A frame relative to the nearest frame below it that a joint moves (or the base): fixed frames in between are
/// folded in, so a chain of fixed frames costs no more than one, and errors do not add up along it.
struct CarriedLink {
  enum class Joint { fixed, revolute, prismatic };
  int parent = 0;  ///< frame it is placed from, smaller than its own
  Joint joint = Joint::fixed;
  bool turned = false;            ///< `turn` is not the identity
  double offset[3] = {0, 0, 0};   ///< m, of this frame's origin in the parent's frame, joint at 0
  double turn[4] = {0, 0, 0, 1};  ///< quaternion x y z w of this frame in the parent's, joint at 0
  double axis[3] = {1, 0, 0};     ///< unit, in the parent's frame
  int along = 1;                  ///< 1, 2, 3: the axis is the x, y, z axis of the parent's frame; 0: slanted

  friend bool operator==(const CarriedLink&, const CarriedLink&) = default;
};

/// Where the state of a link lies: in numbers, from the first of its kind of the same robot (see RobotState).
struct Spot {
  std::ptrdiff_t pose = 0, twist = 0;
  std::ptrdiff_t position = 0, velocity = 0;  ///< of its joint

  friend bool operator==(const Spot&, const Spot&) = default;
};

/// Where the state of a robot lies: pose (position x y z, orientation x y z w) and twist (linear, angular) of the base
/// and of the first link; position (rad or m) and velocity of the first joint.
struct RobotState {
  const double* base_pose = nullptr;
  const double* base_twist = nullptr;
  double* poses = nullptr;
  double* twists = nullptr;
  const double* positions = nullptr;
  const double* velocities = nullptr;
};

struct Kernels {
  /// Fills in pose and twist of all links of up to eight robots with the same links and spots: the bits that each
  /// robot gets alone.
  void (*place)(const CarriedLink* links, const Spot* spots, int link_count, const RobotState* robots, int robot_count);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::kinematics
