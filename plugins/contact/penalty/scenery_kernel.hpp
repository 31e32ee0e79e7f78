// SPDX-License-Identifier: MIT
// Kernel: robots that touch only static scenery, such as vehicles on the ground.
#pragma once

#include <cstddef>
#include <cstdint>

#include "contact_law.hpp"
#include "muro/simd/isa.hpp"
#include "patch.hpp"

namespace muro::penalty {

/// Of a robot that the kernel processes; and of its friction anchors from the step before.
inline constexpr int max_contacts = 32;

/// Where the pose and the twist of a body lie, in numbers from those of its robot's base or first link.
struct BodyOffsets {
  bool of_link = false;
  std::ptrdiff_t pose = 0, twist = 0;

  friend bool operator==(const BodyOffsets&, const BodyOffsets&) = default;
};

/// The order of a robot's contacts. A group: adjacent contacts of one shape of one body with one other shape.
struct ContactLayout {
  int contacts = 0;
  int groups = 0;
  std::uint8_t ends[max_contacts] = {};   ///< of each group: behind its last contact
  double zeta[max_contacts] = {};         ///< of each group: damping ratio of the normal
  BodyOffsets bodies[max_contacts] = {};  ///< of each group

  friend bool operator==(const ContactLayout&, const ContactLayout&) = default;
};

/// One robot. Contacts and anchors are read and written as numbers: see the offsets below.
struct KernelRobot {
  const double* contacts = nullptr;  ///< point of the first
  const double* before = nullptr;    ///< point of the first anchor of the step before; may be `anchors`
  double* anchors = nullptr;         ///< point of the first; out
  const double *base_pose = nullptr, *base_twist = nullptr;
  const double *link_pose = nullptr, *link_twist = nullptr;  ///< of the first link that may touch, if there is one
  double* wrench = nullptr;                                  ///< out
  double* forces = nullptr;  ///< of the first contact; out, where KernelBatch::tells_contacts
};
inline constexpr int contact_stride = 13, anchor_stride = 8, force_stride = 14;  ///< in numbers
/// A contact, from its point on: point, normal, depth, friction. An anchor: point, displacement.
inline constexpr int contact_numbers = 8, anchor_numbers = 6;

/// What the robots of one call share.
struct KernelBatch {
  Stiffness stiffness;
  double elapsed = 0;  ///< s since the last run
  const MassProperties* mass = nullptr;
  const ContactLayout* layout = nullptr;
  const std::uint8_t* anchors_ends = nullptr;  ///< of each group: behind its last anchor of the step before
  /// Of each contact, from 0 to `patches` - 1; null: all are one patch, if their normals agree.
  const std::uint8_t* patch_of = nullptr;
  int patches = 1;
  bool tells_contacts = false;
};

struct SceneryKernels {
  /// Computes the forces of all contacts, their friction anchors and the sum of forces, for up to eight robots; each
  /// gets the same bits as by itself. Returns a bit for each robot whose normals do not agree with one patch; of those
  /// nothing is written.
  unsigned (*apply_forces)(const KernelBatch& batch, const KernelRobot* const* robots, int count);
};
MURO_DECLARE_KERNELS(SceneryKernels, scenery_kernels)

}  // namespace muro::penalty
