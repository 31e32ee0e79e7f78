// SPDX-License-Identifier: MIT
// Kernels: robots whose joints move no mass, such as vehicles on wheels.
#pragma once

#include <cstdint>

#include "muro/lane/isa.hpp"

namespace muro::simplified {

/// What robots of one model have in common. Matrices column by column, in the frame of the base.
struct RigidModel {
  double inverse_mass = 0;  ///< 1/kg
  double com[3] = {};       ///< m
  double inertia[9] = {};   ///< kg m^2, about the centre of mass
  double inverse[9] = {};

  friend bool operator==(const RigidModel&, const RigidModel&) = default;
};

/// A joint without limits of position that follows a velocity: a wheel.
struct Wheel {
  double* position = nullptr;      ///< rad or m
  double* velocity = nullptr;      ///< rad/s or m/s
  const double* target = nullptr;  ///< rad/s or m/s
};
struct WheelLimits {
  double speed = 0, acceleration = 0;
  friend bool operator==(const WheelLimits&, const WheelLimits&) = default;
};

struct RigidRobot {
  double* pose = nullptr;
  double* twist = nullptr;
  const double* wrench = nullptr;  ///< external, at the base
  const Wheel* wheels = nullptr;
};

struct RigidWork {
  const RigidModel* model = nullptr;
  const WheelLimits* limits = nullptr;  ///< one a wheel
  std::uint32_t wheels = 0;
  double gravity[3] = {};
  double dt = 0;  ///< s
};

struct RigidKernels {
  /// Carries one robot, or eight of the same model, over a step: the same bits. Returns a bit for each whose state is
  /// no longer finite.
  unsigned (*move_one)(const RigidWork& work, const RigidRobot* robot);
  unsigned (*move_eight)(const RigidWork& work, const RigidRobot* robots);
};
MURO_DECLARE_KERNELS(RigidKernels, rigid_kernels)

}  // namespace muro::simplified
