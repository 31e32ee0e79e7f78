// SPDX-License-Identifier: MIT
// What the kernel is told of robots that it carries over a step together, and where it finds and puts their state.
#pragma once

#include "muro/simd/isa.hpp"
#include "structure.hpp"

namespace muro::articulated {

/// Of a contact, what few steps need.
struct ContactExtent {
  double rim[3] = {};    ///< m, in the frame of the body: see contact_geometry::ShapeExtent
  double shift[3] = {};  ///< m, world: of faces, from the point to where its friction acts (pressure_cells.hpp)
};
/// A contact that a step resolves. Numbers as they lie in properties.
struct KernelContact {
  /// Point, normal, depth (m, world); friction, restitution, resistance to rolling and to spinning.
  const double* place = nullptr;
  double* kept = nullptr;           ///< from its point on, as KeptContact
  const double* other = nullptr;    ///< velocity of what it touches at the point, and its spin; null: it does not move
  const double* partner = nullptr;  ///< place of the other end, where it may be one of a line; else null
  ContactExtent* extent = nullptr;
  int body = 0;
  std::uint16_t traits = 0;
  std::int16_t face = 0;  ///< so many contacts from here on are of the same two shapes, if more than two; else 0
  /// Of traits: `is_moved`, it has `other`; `may_be_line`, it has `partner`, which is the next contact, or where it
  /// `is_second` the one before; `joins`, it is of the same two shapes as the contact before; `is_of_disc`, see
  /// contact_geometry; `has_cell`, it is one of several points of a face: as find_faces() finds out.
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
/// How many joints of a robot may follow others.
inline constexpr int most_mimics = 32;
/// How many numbers a contact keeps.
inline constexpr int kept_numbers = 14;
/// The load that is kept of a contact that bore nothing.
inline constexpr double unloaded = -1;

/// Where the numbers of a robot are: of its base, of its first joint.
struct RobotState {
  double* pose = nullptr;
  double* twist = nullptr;
  double* positions = nullptr;
  double* velocities = nullptr;
  double* efforts = nullptr;
  const double* targets[target_kinds] = {};  ///< by Drive
  const double* friction_losses = nullptr;
  const double* armature_losses = nullptr;
  const Mass* masses = nullptr;       ///< of its bodies
  double borne_mass = 0;              ///< kg: what its contacts may have to bear, at least its own
  double radius = 0;                  ///< m: of gyration
  KernelContact* contacts = nullptr;  ///< by body, in rising order
  int contact_count = 0;
  std::uint64_t contact_bodies = 0;        ///< their bodies, eight bits each; 0: there are none, or they need more
  std::uint64_t contact_faces = 0;         ///< the same of KernelContact::face; 0: there are none
  const double* wrenches = nullptr;        ///< force and torque on each body at its origin, world axes; null: none
  double* const* body_wrenches = nullptr;  ///< out, or null: the same of all contacts of each body that has some
  double* contact_wrenches = nullptr;      ///< out, or null: force and torque of each contact at its point
  /// Kept from step to step, of the base (world axes, linear and angular) and of each joint: how the last step changed
  /// their velocities, where it was smooth; of a joint whose drive holds a velocity -1 or 1, where that gave all it
  /// can. None of a robot that is one body, and with Runge and Kutta.
  double* accelerations = nullptr;
  bool is_pushed = false;  ///< some of `wrenches` are of contacts: with robots that forces move, or among its links
};

/// What all robots of a call share.
struct Batch {
  Structure structure;
  double gravity[3] = {};       ///< m/s^2
  double dt = 0;                ///< s
  double omega = 0;             ///< rad/s: of a robot that bobs on one contact
  double impact_speed = 0;      ///< m/s: what comes faster rebounds
  double hard_speed = 0;        ///< m/s: what comes faster is stopped at once
  double correcting_speed = 0;  ///< m/s: overlap is parted no faster
  bool runge_kutta = false;     ///< of order 4
  bool equal_masses = true;     ///< all robots have the masses of the first
  void* work = nullptr;         ///< of work_bytes(), aligned to 64 bytes
};

struct Kernels {
  /// For structures of `bodies` bodies, `slots` slots and `mimics` numbers of mimic joints (Structure::mimic_numbers),
  /// and `contacts` contacts of all eight robots together.
  std::size_t (*work_bytes)(int bodies, int slots, int mimics, int contacts);
  /// Carries up to eight robots over a step: the bits that each gets alone. Returns a bit for each whose state is no
  /// longer finite.
  unsigned (*step)(const Batch& batch, const RobotState* robots, int count);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::articulated
