// SPDX-License-Identifier: MIT
// Kernels: joints, and bases of robots whose joints move no mass, such as vehicles on wheels.
#pragma once

#include <cstddef>

#include "muro/simd/isa.hpp"

namespace muro::simplified {

enum class Mode { velocity, position, acceleration };

/// What a joint may do; rad or m.
struct JointRange {
  static constexpr double infinite = __builtin_huge_val();  ///< no limit
  double lower = -infinite, upper = infinite;
  double speed = infinite;
  double acceleration = 1e9;

  friend bool operator==(const JointRange&, const JointRange&) = default;
};

struct Joint {
  JointRange range;
  /// Offsets of its numbers from those of the robot's first joint (see RobotState).
  std::ptrdiff_t position = 0, velocity = 0, target = 0;
  int leader = -1;  ///< number of the joint that it follows; -1: follows its own target
  double multiplier = 1, offset = 0;
  bool four = false;  ///< the numbers of this joint and the next three lie side by side, and none of them has a leader

  friend bool operator==(const Joint&, const Joint&) = default;
};

/// Mass properties of a robot whose joints move no mass. Matrices column by column, in the frame of the base.
struct RigidMass {
  double inverse_mass = 0;  ///< 1/kg
  double com[3] = {};       ///< m
  double inertia[9] = {};   ///< kg m^2, about the centre of mass
  double inverse[9] = {};

  friend bool operator==(const RigidMass&, const RigidMass&) = default;
};

/// Where the state of a robot lies: of its base, of its first joint.
struct RobotState {
  double* pose = nullptr;
  double* twist = nullptr;
  const double* wrench = nullptr;  ///< the first contribution
  double* positions = nullptr;
  double* velocities = nullptr;
  const double* targets = nullptr;
};

/// What the robots of one call of a kernel have in common.
struct BatchParameters {
  Mode mode = Mode::velocity;
  const Joint* joints = nullptr;
  int joint_count = 0;
  const RigidMass* mass = nullptr;
  int wrenches = 1;                                    ///< contributions to the wrench of each robot
  const double* const* other_contributions = nullptr;  ///< all but the first of them, robot by robot
  double gravity[3] = {};                              ///< m/s^2
  double dt = 0;                                       ///< s
};

/// Each carries up to eight robots over a step: the bits that each of them gets alone.
struct Kernels {
  void (*move_joints)(const BatchParameters& batch, const RobotState* robots, int count);
  /// Joints and base. Returns a bit for each robot whose state is no longer finite.
  unsigned (*move_rigid)(const BatchParameters& batch, const RobotState* robots, int count);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::simplified
