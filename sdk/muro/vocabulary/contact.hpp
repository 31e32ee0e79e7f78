// SPDX-License-Identifier: MIT
// Contacts: which algorithm answers for them, what touches, and which wrenches they exert.
#pragma once

#include "muro/key.hpp"
#include "muro/scene.hpp"

namespace muro {

/// Change by impulses J that should have acted a time t before the middle of this step. World axes.
struct ImpactCorrection {
  Vec3 path = Vec3::Zero();  ///< kg m: sum of J t, the path of the centre of mass times the mass
  Vec3 turn = Vec3::Zero();  ///< kg m^2: sum of (lever x J) t, the rotation times the inertia about the centre of mass
  Vec3 carried = Vec3::Zero();  ///< kg m^2/s: sum of J t x u, where u is the velocity of the contact point

  ImpactCorrection& operator+=(const ImpactCorrection& b) {
    path += b.path;
    turn += b.turn;
    carried += b.carried;
    return *this;
  }
};
MURO_OPAQUE_TYPE(ImpactCorrection, "muro.ImpactCorrection", opaque);

}  // namespace muro

namespace muro::keys {

// Properties of a robot's base.
/// A motion with forces writes here who answers for contacts. 0: nobody, no force moves the robot. contact_for_all: the
/// contact algorithm, for all of them. Any other number names a world, which answers for contacts of its robots with
/// each other, with scenery and with robots that no force moves. The contact algorithm answers for their contacts with
/// robots that forces move in another way.
inline constexpr Key<std::uint64_t> contact_world{"contact.world", "1", "who answers for contacts of the robot",
                                                  Role::motion_trait};
inline constexpr std::uint64_t contact_for_all = 1;
/// Number of steps by which the twist is older than the pose. It is 0 if pose and twist belong to one instant and a
/// constant force F carries the centre by v h + F h^2 / 2m. It is 0.5 for semi-implicit Euler, v' = v + F h / m,
/// x' = x + v' h, with velocities of the middles of steps (leapfrog). Contact needs it to keep energy and angular
/// momentum.
inline constexpr Key<double> twist_lag{"twist.lag", "1", "steps by which the twist is older than the pose",
                                       Role::motion_trait};
/// Set by a motion that resolves contacts among the links of a robot and needs the collision algorithm to find them.
/// Links that one joint connects, or only fixed ones, do not touch.
inline constexpr Key<std::uint32_t> self_collision{"self_collision", "1", "1: `contacts` has those among its links",
                                                   Role::motion_trait};

inline constexpr Key<Contact> contacts{"contacts", "m", "list on the base of a robot: where it touches"};
// Lists of single contacts on the base of a robot. Who answers for contacts writes them if something reads them.
/// Contacts of the last step, written by the engine that moves the robot. A robot that no force moves has no such list:
/// its effect on other robots is in their lists.
inline constexpr Key<ContactWrench> contact_wrenches_of_motion{
    "contact.wrenches.motion", "m, N, N m", "list on the base of a robot: what its engine's contacts did to it",
    Role::motion_trait};
/// Contacts of the step that begins, written by the contact algorithm; also on robots that no force moves and that
/// others push.
inline constexpr Key<ContactWrench> contact_wrenches_of_law{
    "contact.wrenches.law", "m, N, N m", "list on the base of a robot: what the contact algorithm does to it"};

// Properties of bodies and of the world.
inline constexpr Key<Wrench> contact_wrench{
    "wrench.contact", "N, N m", "what contacts did to a body in the last step: world axes, at the body's origin",
    Role::motion_trait};
/// Constant on the world object: a FrictionRule (toolkit/pair_surface.hpp). If it is missing, the smaller friction
/// counts.
inline constexpr Key<std::uint32_t> friction_rule{"friction.rule", "1",
                                                  "how a pair's friction follows from those of its two shapes"};

/// Written by a contact algorithm, for motions that resolve contacts with scenery themselves. Each of these contacts
/// may have to carry the mass of all robots that carry each other.
inline constexpr Key<double> carried_mass{
    "contact.carried_mass", "kg",
    "on a base: of all robots that carry each other, itself included; 0 while it carries none and none carries it"};

// Impacts at the instant at which contact begins. Contact begins within a step and is found at its end. The force of
// the next step gives bodies the momentum of the impact. It does not give them the path that an impulse at its instant
// would have caused. A motion that offers `contact.impact.step` takes that path from `contact.impact`, in the step that
// begins at `contact.impact.time`.
inline constexpr Key<double> impact_step{
    "contact.impact.step", "s",
    "on a base: its motion corrects the path after impacts, and takes steps of this length"};
inline constexpr Key<std::int64_t> impact_time{"contact.impact.time", "ns",
                                               "on a base: begin of the step that `contact.impact` is for"};
inline constexpr Key<ImpactCorrection> impact{"contact.impact", "kg m",
                                              "on a base: the path that impacts change beyond what their force does"};

}  // namespace muro::keys
