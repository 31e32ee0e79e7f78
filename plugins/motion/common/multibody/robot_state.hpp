// SPDX-License-Identifier: MIT
// Data exchanged between the properties of a scene and an engine's world in each step.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "muro/geometry.hpp"

namespace muro::multibody {

/// The way a world treats a robot or an external body at present.
enum class MotionType : std::uint8_t {
  dynamic,    ///< the world moves it
  kinematic,  ///< no force moves it: it pushes others and is not pushed
  disabled,   ///< forces move it in another world: contact with it is not resolved here
};

/// The task of a joint's drive in a step.
struct DriveTarget {
  bool tracks_velocity = false;  ///< reach `velocity` with an effort of at most `max_effort`; else `effort` acts
  double velocity = 0;           ///< rad/s or m/s
  double max_effort = 0;         ///< N m or N; may be infinite
  double effort = 0;             ///< N m or N
  double friction = 0;           ///< N m or N: Coulomb friction of the joint, in addition to the drive
  double mimic_lead = 0;         ///< rad/s or m/s: of a mimic joint, velocity above the multiple of its leader's
  /// N m s/rad or N s/m: effort per difference between `velocity` and the velocity at the end of the step. Infinite: as
  /// stiff as the engine can.
  double damping = std::numeric_limits<double>::infinity();

  /// Softness of the drive as a constraint (CFM of ODE and Bullet): rad/s per N m or m/s per N.
  double softness() const { return 1 / damping; }
};

/// State of a body's joint; unused for the base.
struct JointState {
  double position = 0;  ///< rad or m, along the axis
  double velocity = 0;
  double effort = 0;          ///< out: effort of the drive in the last step
  double drive_friction = 0;  ///< N m or N: friction of the drive of a joint in mode effort
  double drive_armature = 0;  ///< kg m^2 or kg: armature of that drive
  DriveTarget target;
};

/// An overlap of a robot with scenery.
struct Overlap {
  double depth = 0;                       ///< m
  std::uint32_t loaded_link = 0;          ///< see RobotModel
  const std::string* obstacle = nullptr;  ///< its name; null when nothing overlaps

  /// Keeps the deeper overlap.
  void add(double other_depth, std::uint32_t link, const std::string& name) {
    if (other_depth > depth) *this = {other_depth, link, &name};
  }
};

/// State of a robot, in and out.
struct RobotState {
  MotionType motion_type = MotionType::dynamic;
  Pose pose;                       ///< pose of the base
  Twist twist;                     ///< twist of the base, at its origin
  std::vector<JointState> joints;  ///< one per body
  std::vector<Wrench> external;    ///< in: one per body, at the body's origin, world axes
  std::vector<Wrench> contact;     ///< out: wrench of the world's contacts, one per loaded link, at its body's origin
  bool tells_contacts = false;     ///< in: whether `contacts` are needed
  /// Out: contacts of the last step. Each dynamic robot that takes part in a contact has it here, with its own body
  /// first. A contact of two bodies of one robot is there once.
  std::vector<ContactWrench> contacts;
  Overlap overlap;                   ///< out: the deepest overlap with scenery in the last step
  bool moved_from_outside = false;   ///< in: the robot is not where it was at the end of the last step
  bool has_external_wrench = false;  ///< in: some `external` is not zero
  std::span<double> memory;          ///< in and out: values that the engine keeps for it, part of the state

  void clear_contacts() {
    for (Wrench& w : contact) w = Wrench{};
    contacts.clear();
  }
};

/// Pose (world) and twist (at the body's origin, world axes) of a body.
struct BodyState {
  Pose pose;
  Twist twist;
};

}  // namespace muro::multibody
