// SPDX-License-Identifier: MIT
// Who resolves a contact: the one place that decides it, for motions, collision and contact algorithms.
//
// A contact between two bodies must be resolved exactly once: by the physics engine that moves both of them, or by the
// contact algorithm, which works on robots of any motion. Resolved by both, bodies would be pushed twice; by neither,
// they would pass through each other. The robots of a team may be moved by different motions, and a robot may change
// its motion in the middle of a run, so the answer is found anew in each step, from one property of each robot:
// `contact.world` on its base (keys::contact_world), which the motion that moves the robot writes.
//
//   contact.world   meaning                                          written by
//   0               kinematic: no force moves the robot              motion.point, motion.differential_drive, ...
//   1               the contact algorithm resolves all contacts      motion.simplified
//   2 and above     number of the physics world that moves it        motion.bullet, motion.ode, motion.mujoco
//                   or of the robot alone                            motion.articulated
//
// Scenery counts as kinematic. What a contact does to a robot (row) that touches another (column) is found by
//
//                     other: scenery or 0     1                    same world   another world
//   own: 0            nobody                  nobody               -            nobody
//   own: 1            contact algorithm       contact algorithm    -            contact algorithm
//   own: a world      the world               contact algorithm    the world    contact algorithm
//
// The table is symmetric where forces move both robots, so that both agree on who resolves their contact and the
// impulses are equal and opposite. A kinematic robot pushes, blocks and drags, and is not pushed itself.
//
// From the table follows what each algorithm does:
// - a motion without an engine writes its constant (contact_world_of);
// - a world simulates its own robots, takes kinematic robots as obstacles that it cannot move, and leaves out all
//   robots that other forces move (is_moved_by_forces);
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

/// `contact.world` of the robots of a physics world. `hash`: tells worlds apart.
constexpr std::uint64_t number_of_world(std::uint64_t hash) { return std::max(hash, keys::contact_for_all + 1); }

/// Who finds what a contact of two robots does to the first. `own`, `other`: their `contact.world`.
constexpr ContactResolver contact_resolver(std::uint64_t own, std::uint64_t other) {
  if (!is_moved_by_forces(own)) return ContactResolver::nobody;
  const bool in_own_world = is_in_world(own) && (!is_moved_by_forces(other) || other == own);
  return in_own_world ? ContactResolver::world : ContactResolver::contact_algorithm;
}

/// Whether the contact algorithm finds what a contact of two robots does to the first.
constexpr bool contact_algorithm_resolves(std::uint64_t own, std::uint64_t other) {
  return contact_resolver(own, other) == ContactResolver::contact_algorithm;
}

}  // namespace muro
