// SPDX-License-Identifier: MIT
// Kernels that move joints, and bases of robots whose joints move no mass, such as vehicles on wheels.
#pragma once

#include <cstddef>

#include "muro/simd/isa.hpp"

namespace muro::simplified {

enum class Mode { velocity, position, acceleration };

/// Limits of a joint; rad or m.
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
  bool four = false;  ///< this joint and the next three are adjacent in memory, and none has a leader

  friend bool operator==(const Joint&, const Joint&) = default;
};

/// Mass properties of a robot whose joints move no mass. Matrices are column by column, in the frame of the base.
struct RigidMass {
  double inverse_mass = 0;  ///< 1/kg
  double com[3] = {};       ///< m
  double inertia[9] = {};   ///< kg m^2, about the centre of mass
  double inverse[9] = {};

  friend bool operator==(const RigidMass&, const RigidMass&) = default;
};

/// Addresses of the state of a robot: of its base and of its first joint.
struct RobotState {
  double* pose = nullptr;
  double* twist = nullptr;
  const double* wrench = nullptr;  ///< the first contribution
  double* positions = nullptr;
  double* velocities = nullptr;
  const double* targets = nullptr;
};

/// Common data of the robots in one call of a kernel.
struct BatchParameters {
  Mode mode = Mode::velocity;
  const Joint* joints = nullptr;
  int joint_count = 0;
  const RigidMass* mass = nullptr;
  int wrenches = 1;                                    ///< contributions to the wrench of each robot
  const double* const* other_contributions = nullptr;  ///< all except the first, robot by robot
  double gravity[3] = {};                              ///< m/s^2
  double dt = 0;                                       ///< s
};

/// Each kernel advances up to eight robots by a step, with the same bits as each robot alone.
struct Kernels {
  void (*move_joints)(const BatchParameters& batch, const RobotState* robots, int count);
  /// Moves joints and base. Returns a bit for each robot whose state is no longer finite.
  unsigned (*move_rigid)(const BatchParameters& batch, const RobotState* robots, int count);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::simplified
