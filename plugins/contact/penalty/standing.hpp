// SPDX-License-Identifier: MIT
// Kernel: robots that touch nothing that moves, such as vehicles on the ground.
#pragma once

#include <cstddef>
#include <cstdint>

#include "contact_law.hpp"
#include "muro/simd/isa.hpp"
#include "patch.hpp"

namespace muro::penalty {

/// At most so many contacts, and as many springs of the step before, has a robot that the kernel serves.
inline constexpr int most_contacts = 32;

/// Where the pose and the twist of a body lie: so many numbers behind those of its robot's base, or of its first link.
struct BodyPlace {
  bool of_link = false;
  std::ptrdiff_t pose = 0, twist = 0;

  friend bool operator==(const BodyPlace&, const BodyPlace&) = default;
};

/// How the contacts of a robot belong together. A group: those of one body and shape with one other, side by side.
struct Layout {
  int contacts = 0;
  int groups = 0;
  std::uint8_t ends[most_contacts] = {};  ///< of each group: behind its last contact
  double zeta[most_contacts] = {};        ///< of each group: damping ratio of the normal
  BodyPlace bodies[most_contacts] = {};   ///< of each group

  friend bool operator==(const Layout&, const Layout&) = default;
};

/// One robot. Contacts and grips are read and written as numbers: see the offsets below.
struct StandingRobot {
  const double* contacts = nullptr;  ///< point of the first
  const double* before = nullptr;    ///< point of the first grip of the step before; may be `grips`
  double* grips = nullptr;           ///< point of the first; out
  const double *base_pose = nullptr, *base_twist = nullptr;
  const double *link_pose = nullptr, *link_twist = nullptr;  ///< of the first link that may touch, if there is one
  double* wrench = nullptr;                                  ///< out
};
inline constexpr int contact_stride = 11, grip_stride = 7;  ///< in numbers
/// A contact, from its point on: point, normal, depth, friction. A grip: point, stretch.
inline constexpr int contact_numbers = 8, grip_numbers = 6;

/// What the robots of one call have in common.
struct StandingWork {
  Stiffness stiffness;
  double elapsed = 0;  ///< s since the last run
  const MassProperties* mass = nullptr;
  const Layout* layout = nullptr;
  const std::uint8_t* springs_ends = nullptr;  ///< of each group: behind its last spring of the step before
  /// Of each contact, from 0 to `patches` - 1; null: they make one patch, if their normals say so.
  const std::uint8_t* patch_of = nullptr;
  int patches = 1;
};

struct StandingKernels {
  /// Forces of all contacts, their friction springs, and their sum, for up to eight robots: the bits that each gets
  /// alone. Returns a bit for each robot whose normals do not make the one patch that they should; of such a robot
  /// nothing has been written.
  unsigned (*push)(const StandingWork& work, const StandingRobot* const* robots, int count);
};
MURO_DECLARE_KERNELS(StandingKernels, standing_kernels)

}  // namespace muro::penalty
