// SPDX-License-Identifier: MIT
// What passes between the properties of a scene and an engine's world in each step.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "muro/geometry.hpp"

namespace muro::multibody {

/// How a world treats a robot, or a body that is not of the world, at present.
enum class MotionType : std::uint8_t {
  dynamic,    ///< the world moves it
  kinematic,  ///< no force moves it: it pushes and is not pushed
  disabled,   ///< forces move it elsewhere: contact with it is not resolved here
};

/// What the drive of a joint is to do in a step.
struct DriveTarget {
  bool tracks_velocity = false;  ///< reach `velocity` with an effort of at most `max_effort`; else `effort` acts
  double velocity = 0;           ///< rad/s or m/s
  double max_effort = 0;         ///< N m or N; may be infinite
  double effort = 0;             ///< N m or N
  double friction = 0;           ///< N m or N: Coulomb friction of the joint, beside the drive
  double mimic_lead = 0;         ///< rad/s or m/s: of a mimic joint, velocity beyond its multiple of its leader's
  /// N m s/rad or N s/m: effort by what the velocity at the end of the step lacks of `velocity`. Infinite: as hard as
  /// the engine can.
  double damping = std::numeric_limits<double>::infinity();

  /// Of the constraint that it is (CFM of ODE and Bullet): rad/s by N m or m/s by N.
  double softness() const { return 1 / damping; }
};

/// State of a body's joint; unused for the base.
struct JointState {
  double position = 0;  ///< rad or m, along the axis
  double velocity = 0;
  double effort = 0;          ///< out: what the drive applied in the last step
  double drive_friction = 0;  ///< N m or N: of the drive in front of a joint that efforts drive
  double drive_armature = 0;  ///< kg m^2 or kg: the same
  DriveTarget target;
};

/// Where a robot overlaps scenery.
struct Overlap {
  double depth = 0;                       ///< m
  std::uint32_t loaded_link = 0;          ///< see RobotModel
  const std::string* obstacle = nullptr;  ///< its name; null where nothing overlaps

  /// Keeps the deeper one.
  void add(double other_depth, std::uint32_t link, const std::string& name) {
    if (other_depth > depth) *this = {other_depth, link, &name};
  }
};

/// State of a robot, in and out.
struct RobotState {
  MotionType motion_type = MotionType::dynamic;
  Pose pose;                       ///< of the base
  Twist twist;                     ///< of the base, at its origin
  std::vector<JointState> joints;  ///< one per body
  std::vector<Wrench> external;    ///< in: one per body, at the body's origin, world axes
  std::vector<Wrench> contact;     ///< out: one per loaded link, at its body's origin: by contacts in the world
  bool tells_contacts = false;     ///< in: whether `contacts` are wanted
  /// Out: those of the last step, in each dynamic robot with a part in them, there with a body of it first; contact of
  /// two bodies of a robot once.
  std::vector<ContactWrench> contacts;
  Overlap overlap;                   ///< out: the deepest with scenery in the last step
  bool moved_from_outside = false;   ///< in: it is not where the last step left it
  bool has_external_wrench = false;  ///< in: some `external` is not zero
  std::span<double> memory;          ///< in and out: what the engine keeps of it, part of the state

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
