// SPDX-License-Identifier: MIT
// Kernels: robots that stand on scenery with one patch of contacts, as vehicles on the ground do, eight at a time.
#pragma once

#include <cstdint>

#include "muro/lane/isa.hpp"

namespace muro::penalty {

/// At most so many contacts has a robot that the kernels serve.
inline constexpr int most_contacts = 16;

/// Mass properties of a robot, in the frame of its base, in one piece. Matrices column by column.
struct StandingMass {
  double inverse_mass = 0;         ///< 1/kg
  double com[3] = {};              ///< m
  double inverse_inertia[9] = {};  ///< 1/(kg m^2), about the centre of mass
};

/// One robot. Contacts and grips are read and written as numbers: see the offsets below.
struct StandingRobot {
  const double* contacts = nullptr;  ///< point of the first
  double* grips = nullptr;           ///< point of the first: those of the step before, then of this one
  const double* base_pose = nullptr;
  const double* base_twist = nullptr;
  const StandingMass* mass = nullptr;
  double* wrench = nullptr;                     ///< out
  const double* body_pose[most_contacts] = {};  ///< of each group
  const double* body_twist[most_contacts] = {};
};
inline constexpr int contact_stride = 11, grip_stride = 7;                      ///< in numbers
inline constexpr int normal_number = 3, depth_number = 6, friction_number = 7;  ///< behind the point of a contact
inline constexpr int stretch_number = 3;                                        ///< behind the point of a grip

/// What robots of one call have in common.
struct StandingWork {
  int contacts = 0;
  int groups = 0;                ///< of contacts that share body and shape, side by side
  int ends[most_contacts] = {};  ///< of each group
  double omega = 0, h = 0;       ///< rad/s, s
  double zeta = 0;               ///< damping ratio of the normal
  double z = 0;                  ///< tanh(zeta omega h)
  double elapsed = 0;            ///< s since the last run
  double same_direction = 0;     ///< cosine of the widest angle between normals of one patch
};

struct StandingKernels {
  /// Forces of all contacts, their friction springs, and their sum. Returns a bit for each robot whose normals do not
  /// make one patch; of such a robot nothing has been written. The same bits for one robot and for eight.
  unsigned (*push_one)(const StandingWork& work, const StandingRobot* const* robots);
  unsigned (*push_eight)(const StandingWork& work, const StandingRobot* const* robots);
};
MURO_DECLARE_KERNELS(StandingKernels, standing_kernels)

}  // namespace muro::penalty
