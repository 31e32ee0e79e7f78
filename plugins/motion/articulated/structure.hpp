// SPDX-License-Identifier: MIT
// A robot in the form of the articulated-body algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter
// 4): bodies in a tree, each with the joint that leads to it. Robots of one pack share it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace muro::articulated {

/// Mass and inertia of a body, in its frame.
struct Mass {
  double mass = 0;         ///< kg
  double moment[3] = {};   ///< kg m: mass times centre of mass
  double inertia[6] = {};  ///< kg m^2, about the origin: xx yy zz yz zx xy

  static constexpr int numbers = 10;
  friend bool operator==(const Mass&, const Mass&) = default;
};
static_assert(sizeof(Mass) == Mass::numbers * sizeof(double));

/// A body with the joint that leads to it. The origin of its frame is on the joint's axis, which is its x, y or z axis.
/// At joint position 0 the frame is parallel to the parent's frame, or turned by a constant rotation. Bodies behind
/// fixed joints are parts of their parents.
struct Body {
  int parent = -1;  ///< always smaller than its own number; -1: the base
  int axis = 0;     ///< axis of the joint: 0, 1, 2
  bool slides = false;
  bool shifted = false;   ///< offset is not 0
  bool turned = false;    ///< `turn` is not the identity
  int slot = -1;          ///< place where inertias of its children add up; -1: it has no children
  int parent_slot = -1;   ///< `slot` of the parent
  bool first = false;     ///< it is the first child that is added to the slot of its parent
  bool kept = false;      ///< it has children and its parent has others: the inertia that it hands on is kept
  double sign = 1;        ///< -1: the joint of the model turns about, or shifts along, the opposite axis
  double offset[3] = {};  ///< m: position of the origin in the parent's frame at joint position 0
  double turn[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< columns: axes of the frame in the parent's at joint position 0

  friend bool operator==(const Body&, const Body&) = default;
};

/// Target that a joint follows.
enum class Drive : std::uint8_t { velocity, position, acceleration, effort, passive };
inline constexpr int target_kinds = 4;  ///< all but passive

/// Commands and limits of a joint; of body number k, in the direction of the model.
struct Joint {
  static constexpr double infinite = __builtin_huge_val();

  Drive drive = Drive::passive;
  int leader = -1;  ///< body of the leader: q = offset + multiplier q_leader
  double multiplier = 1, offset = 0;
  double lower = -infinite, upper = infinite;  ///< rad or m
  double speed = infinite, effort = infinite;  ///< limits of the drive
  double damping = 0, friction = 0;            ///< N m s/rad or N s/m; N m or N
  double armature = 0;                         ///< kg m^2 or kg
  double stiffness = -1, drive_damping = -1;   ///< of a position drive; -1: follows from the moved inertia
  double natural_frequency = 0;                ///< rad/s: frequency of a drive whose stiffness follows from the inertia
  // Offsets of its numbers from those of the first joint of the robot that has such numbers (RobotState).
  std::ptrdiff_t position = 0, velocity = 0, out_effort = 0, target = 0, target_velocity = 0, friction_loss = 0,
                 armature_loss = 0;
  bool has_target_velocity = false;                           ///< a target velocity of a position drive is given
  bool has_friction_loss = false, has_armature_loss = false;  ///< losses of what drives it, beside its own

  bool needs_inertia() const { return drive == Drive::position && (stiffness < 0 || drive_damping < 0); }
  friend bool operator==(const Joint&, const Joint&) = default;
};

/// Mimic joints and their leaders, and the bodies between these joints and their anchor: the body from which they all
/// hang. Groups share no bodies; the anchor of one may be a body of another.
struct MimicGroup {
  int anchor = 0;
  int first_way = 0, ways = 0;     ///< range in Structure::mimic_ways
  int first_body = 0, bodies = 0;  ///< range in Structure::mimic_bodies

  friend bool operator==(const MimicGroup&, const MimicGroup&) = default;
};
/// Bodies below the anchor that the efforts of a mimic joint and of its leader reach.
struct MimicWay {
  int body = 0;                     ///< the body whose joint follows
  int first_place = 0, places = 0;  ///< range in Structure::mimic_places: numbers of bodies of the group

  friend bool operator==(const MimicWay&, const MimicWay&) = default;
};

/// Body 0 is the base; its Joint is not used.
struct Structure {
  const Body* bodies = nullptr;  ///< parents before children
  const Joint* joints = nullptr;
  int count = 0;
  int slots = 0;                             ///< number of places where inertias of children wait for their parents
  bool fixed = false;                        ///< the base does not move
  bool has_mimics = false;                   ///< some joint has a leader
  bool needs_inertia = false;                ///< some joint needs it
  const MimicGroup* mimic_groups = nullptr;  ///< sorted by anchor, in falling order
  int mimic_group_count = 0;
  const MimicWay* mimic_ways = nullptr;
  const int* mimic_bodies = nullptr;  ///< bodies of each group in rising order
  const int* mimic_places = nullptr;  ///< places of each way in falling order
  int mimic_numbers = 0;              ///< numbers that the largest group takes: (ways + 1) bodies
  bool lie_side_by_side = false;      ///< positions, velocities and efforts of joints are each in the order of bodies
};

}  // namespace muro::articulated
