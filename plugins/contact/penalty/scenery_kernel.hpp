// SPDX-License-Identifier: MIT
// Kernel: contacts with static scenery, such as those of vehicles with the ground.
#pragma once

#include <cstddef>
#include <cstdint>

#include "contact_law.hpp"
#include "muro/simd/isa.hpp"
#include "patch.hpp"

namespace muro::penalty {

/// Limit of the contacts of a robot that the kernel processes, and of its friction anchors from the step before.
inline constexpr int max_contacts = 32;

/// Data that do not change while a contact lasts.
struct KernelContact {
  std::ptrdiff_t pose = 0, twist = 0;  ///< offset of those of its body from the first contact's, in numbers
  double zeta = 0;                     ///< damping ratio of the normal
  std::uint8_t place = 0;              ///< place in the list of the robot's contacts
  std::uint8_t anchor = 0;             ///< place of its friction anchor, out
  std::uint8_t anchors_begin = 0, anchors_end = 0;  ///< anchors of its group, of the step before
  std::uint8_t object = 0;                          ///< number of the scenery object among those that the robot touches
  bool is_of_disc = false;                          ///< if it touches flat, it is a point of a rim

  friend bool operator==(const KernelContact&, const KernelContact&) = default;
};

/// Data that do not change while the contacts of a robot last. A group is a run of adjacent contacts of one shape of
/// one body with one other shape.
struct LastingContacts {
  const KernelContact* contacts = nullptr;  ///< the first contact
  std::uint32_t groups = 0;                 ///< bit k: contact k is the first of a group
  std::uint8_t count = 0;                   ///< number of contacts, at least one
  bool has_many_materials = false;          ///< zeta differs
  bool has_many_objects = false;
  bool rolls = false;  ///< some contacts are on the base itself and may move over it, as on a rim
  const double *pose = nullptr, *twist = nullptr;  ///< of the body of the first contact
  const double *base_pose = nullptr, *base_twist = nullptr;
  const double* mass = nullptr;  ///< numbers of MassProperties
  double* wrench = nullptr;      ///< on the base; out
};

/// One robot. Contacts and anchors are read and written as numbers: see the offsets below.
struct KernelRobot : LastingContacts {
  bool in_order = false;           ///< contact k has place k, and so has its anchor, also that of the step before
  bool is_changed = false;         ///< some contacts may be new, and may be impacts
  const double* listed = nullptr;  ///< point of the first listed contact
  const double* before = nullptr;  ///< point of the first anchor of the step before; may be `anchors`
  double* anchors = nullptr;       ///< point of the first anchor; out
  /// Ways of robots that roll: of the first anchor of the step before, may be `ways`; and of the first anchor; out.
  const double* ways_before = nullptr;
  double* ways = nullptr;
  double* forces = nullptr;  ///< force and torque of the first of `contacts`; out, where KernelBatch::tells_contacts
};
inline constexpr int contact_stride = 13, anchor_stride = 7, way_stride = 4, force_stride = 14;  ///< in numbers
/// Numbers of a contact, from its point on: point, normal, depth, friction. Numbers of an anchor: point, displacement.
inline constexpr int contact_numbers = 8, anchor_numbers = 6;

/// Values that the robots of one call share.
struct KernelBatch {
  Stiffness stiffness;
  double elapsed = 0;       ///< s since the last run
  double impact_speed = 0;  ///< m/s: see `apply_forces`; infinite: all robots are processed
  bool tells_contacts = false;
};

struct SceneryKernels {
  /// Computes the forces of all contacts, their friction anchors and the sum of forces, for up to eight robots. Each
  /// robot gets the same bits as alone. Contacts with one object of the scenery are a patch if their normals agree.
  /// Friction of contacts of a patch that are also of one group acts as the pressure over their line or face
  /// (pressure_cells.hpp). Returns a bit for each robot that may be in an impact: it has several patches or is changed,
  /// and approaches the scenery faster than `impact_speed` in a point that is far from all friction anchors of its
  /// group. Nothing is written for these robots.
  unsigned (*apply_forces)(const KernelBatch& batch, const KernelRobot* const* robots, int count);
};
MURO_DECLARE_KERNELS(SceneryKernels, scenery_kernels)

}  // namespace muro::penalty
