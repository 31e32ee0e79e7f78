// SPDX-License-Identifier: MIT
// Inputs of the kernel for robots that it moves through a step together, and the places of their state.
#pragma once

#include "muro/simd/isa.hpp"
#include "structure.hpp"

namespace muro::articulated {

/// Data of a contact that few steps need.
struct ContactExtent {
  double rim[3] = {};    ///< m, in the frame of the body: see contact_geometry::ShapeExtent
  double shift[3] = {};  ///< m, world: in a face, from the point to where its friction acts (pressure_cells.hpp)
};
/// A contact that a step resolves. Its pointers lead to numbers in the layout of the properties.
struct KernelContact {
  /// Point, normal, depth (m, world); friction, restitution, resistance to rolling and to spinning.
  const double* place = nullptr;
  double* kept = nullptr;           ///< numbers of KeptContact, from its `point` on
  const double* other = nullptr;    ///< velocity at the point and spin of the touched body; null: that does not move
  const double* partner = nullptr;  ///< `place` of the other end if this may be an end of a line; else null
  ContactExtent* extent = nullptr;
  int body = 0;
  std::uint16_t traits = 0;
  std::int16_t face = 0;  ///< number of contacts from here on between the same two shapes, if more than two; else 0
  /// Traits. `is_moved`: it has `other`. `may_be_line`: it has `partner`, which is the next contact, or the contact
  /// before if `is_second`. `joins`: it is between the same two shapes as the contact before. `is_of_disc`: see
  /// contact_geometry. `has_cell`: it is one of several points of a face, as find_faces() finds.
  enum : unsigned {
    resists_turning = 1,
    has_rim = 2,
    has_cell = 4,
    is_moved = 8,
    may_be_line = 16,
    is_second = 32,
    joins = 64,
    is_of_disc = 128
  };

  void set(unsigned trait, bool on) { traits = std::uint16_t(on ? traits | trait : traits & ~trait); }
};
/// Largest number of joints of a robot that follow others.
inline constexpr int most_mimics = 32;
/// Count of the numbers that a contact keeps.
inline constexpr int kept_numbers = 14;
/// Value of the kept load of a contact that bore nothing.
inline constexpr double unloaded = -1;

/// Places of the numbers of a robot: those of its base, and those of its first joint.
struct RobotState {
  double* pose = nullptr;
  double* twist = nullptr;
  double* positions = nullptr;
  double* velocities = nullptr;
  double* efforts = nullptr;
  const double* targets[target_kinds] = {};  ///< indexed by Drive
  const double* friction_losses = nullptr;
  const double* armature_losses = nullptr;
  const Mass* masses = nullptr;       ///< masses of its bodies
  double borne_mass = 0;              ///< kg: mass that its contacts may have to bear; at least its own
  double radius = 0;                  ///< m: radius of gyration
  KernelContact* contacts = nullptr;  ///< sorted by body, in rising order
  int contact_count = 0;
  std::uint64_t contact_bodies = 0;        ///< bodies of the contacts, eight bits each; 0: none, or they need more bits
  std::uint64_t contact_faces = 0;         ///< KernelContact::face of the contacts, eight bits each; 0: there are none
  const double* wrenches = nullptr;        ///< force and torque on each body at its origin, world axes; null: none
  double* const* body_wrenches = nullptr;  ///< out, or null: summed wrench of the contacts of each body that has some
  double* contact_wrenches = nullptr;      ///< out, or null: force and torque of each contact at its point
  /// Numbers kept from step to step, of the base (world axes, linear and angular) and of each joint: the rate at which
  /// the last step changed its velocity, if that was smooth. For a joint whose drive holds a velocity: -1 or 1 if the
  /// drive gave all it can. Null for a robot of one body, and with Runge and Kutta.
  double* accelerations = nullptr;
  bool is_pushed = false;  ///< some of `wrenches` come from contacts with robots that forces move, or among its links
};

/// Data that all robots of a call share.
struct Batch {
  Structure structure;
  double gravity[3] = {};       ///< m/s^2
  double dt = 0;                ///< s
  double omega = 0;             ///< rad/s: frequency of a robot that bobs on one contact
  double impact_speed = 0;      ///< m/s: faster contact points rebound
  double hard_speed = 0;        ///< m/s: faster contact points are stopped at once
  double correcting_speed = 0;  ///< m/s: overlapping bodies are parted no faster
  bool runge_kutta = false;     ///< integrates by Runge and Kutta of order 4
  bool equal_masses = true;     ///< all robots have the masses of the first
  void* work = nullptr;         ///< memory of work_bytes() bytes, aligned to 64 bytes
};

struct Kernels {
  /// Returns the size of Batch::work for structures of `bodies` bodies, `slots` slots and `mimics` numbers of mimic
  /// joints (Structure::mimic_numbers), and for `contacts` contacts of all eight robots together.
  std::size_t (*work_bytes)(int bodies, int slots, int mimics, int contacts);
  /// Moves up to eight robots through a step. Each gets the same bits as it would get alone. Returns a bit for each
  /// robot whose state is no longer finite.
  unsigned (*step)(const Batch& batch, const RobotState* robots, int count);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::articulated
