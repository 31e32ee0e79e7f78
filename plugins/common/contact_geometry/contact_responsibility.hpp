// SPDX-License-Identifier: MIT
// Rule for who resolves a contact. Motions, collision and contact algorithms decide it only here.
//
// A contact between two bodies must be resolved exactly once: by the physics engine that moves both of them, or by the
// contact algorithm, which works on robots of any motion. If both resolved it, bodies would be pushed twice; if neither
// did, they would pass through each other. The robots of a team may be moved by different motions, and a robot may
// change its motion during a run. So the answer is found again in each step, from one property of each robot:
// `contact.world` on its base (keys::contact_world), which the motion that moves the robot writes.
//
//   contact.world   meaning                                          written by
//   0               kinematic: no force moves the robot              motion.point, motion.differential_drive, ...
//   1               the contact algorithm resolves all contacts      motion.simplified
//   2 and above     number of the physics world that moves it        motion.bullet, motion.ode, motion.mujoco
//                   or of the robot alone                            motion.articulated
//
// Scenery counts as kinematic. The effect of a contact on a robot (row) that touches another (column) is found by
//
//                     other: scenery or 0     1                    same world   another world
//   own: 0            nobody                  nobody               -            nobody
//   own: 1            contact algorithm       contact algorithm    -            contact algorithm
//   own: a world      the world               contact algorithm    the world    contact algorithm
//
// If forces move both robots, the table is symmetric, so that both agree on who resolves their contact and the impulses
// are equal and opposite. A kinematic robot pushes, blocks and drags, and is not pushed itself.
//
// The table decides what each algorithm does:
// - a motion without an engine writes its constant (contact_world_of);
// - a world simulates its own robots, takes kinematic robots as obstacles that it cannot move, and ignores all robots
//   that other forces move (is_moved_by_forces);
// - a collision algorithm lists, for each robot, the contacts that the contact algorithm resolves
//   (contact_algorithm_resolves), and the contact algorithm resolves them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "muro/vocabulary.hpp"

namespace muro {

/// `contact.world` of a robot that no force moves, and of scenery.
inline constexpr std::uint64_t kinematic_world = 0;

enum class ContactResolver : std::uint8_t { nobody, contact_algorithm, world };

/// Whether forces move the robot, so that contacts can push it.
constexpr bool is_moved_by_forces(std::uint64_t contact_world) { return contact_world != kinematic_world; }

/// Whether the robot is simulated by a physics world.
constexpr bool is_in_world(std::uint64_t contact_world) { return contact_world > keys::contact_for_all; }

/// `contact.world` of a robot of a motion without a world of its own.
constexpr std::uint64_t contact_world_of(bool moved_by_forces) {
  return moved_by_forces ? keys::contact_for_all : kinematic_world;
}

/// `contact.world` of the robots of a physics world. `hash`: differs between worlds.
constexpr std::uint64_t number_of_world(std::uint64_t hash) { return std::max(hash, keys::contact_for_all + 1); }

/// Returns who finds the effect of a contact of two robots on the first. `own`, `other`: their `contact.world`.
constexpr ContactResolver contact_resolver(std::uint64_t own, std::uint64_t other) {
  if (!is_moved_by_forces(own)) return ContactResolver::nobody;
  const bool in_own_world = is_in_world(own) && (!is_moved_by_forces(other) || other == own);
  return in_own_world ? ContactResolver::world : ContactResolver::contact_algorithm;
}

/// Whether the contact algorithm finds the effect of a contact of two robots on the first.
constexpr bool contact_algorithm_resolves(std::uint64_t own, std::uint64_t other) {
  return contact_resolver(own, other) == ContactResolver::contact_algorithm;
}

}  // namespace muro
