// SPDX-License-Identifier: MIT
// A leg of six joints: hip yaw, roll and pitch, knee, ankle pitch and roll. It gives the place of the sole, and the
// angles for such a place in closed form.
#pragma once

#include <array>

#include "frame.hpp"

namespace walking {

/// Dimensions of the left leg in m; the right leg is mirrored at y = 0. The axes of hip yaw (z) and hip roll (x) meet
/// in one point. The axes of hip roll and pitch need not meet, nor those of ankle pitch and roll. Offsets along an axis
/// do not matter, except for their sum: all of them along the pitch axes make `leg_y`.
struct LegDimensions {
  Vector hip;              ///< point where the axes of yaw and roll meet, in the frame of the trunk
  double hip_pitch_x = 0;  ///< axis of hip pitch ahead of that point, with hip roll at 0
  double hip_pitch_z = 0;  ///< axis of hip pitch above that point
  double leg_y = 0;        ///< axis of ankle roll outwards of that of hip roll, both at 0
  double thigh = 0.1;      ///< from hip pitch down to the knee
  double knee_x = 0;       ///< knee ahead of the hip's pitch axis, with hip pitch at 0
  double shin = 0.1;       ///< from the knee down to ankle pitch
  double ankle_x = 0;      ///< ankle ahead of the knee, with all angles at 0
  double ankle_z = 0;      ///< axis of ankle roll below that of ankle pitch
  double sole_x = 0;       ///< centre of the sole ahead of ankle pitch
  double sole_y = 0;       ///< centre of the sole outwards of the axis of ankle roll
  double sole_z = 0.03;    ///< centre of the sole below the axis of ankle roll
};

enum LegJoint { hip_yaw, hip_roll, hip_pitch, knee, ankle_pitch, ankle_roll, leg_joints };
using LegAngles = std::array<double, leg_joints>;  ///< rad, in the positive sense of REP-103: a bent knee is above 0

/// Place and axis of a joint, in the frame of the trunk.
struct JointAxis {
  Vector origin, axis;
};

class Leg {
 public:
  /// `side`: 1 for the left leg, -1 for the right one.
  Leg(const LegDimensions& dimensions, double side) : d_(dimensions), side_(side) {}

  double side() const { return side_; }
  /// Returns the distance from hip pitch to ankle pitch of the straight leg, m.
  double length() const;
  /// Returns the sole's frame in that of the trunk, origin in its centre, z up.
  Frame sole_at(const LegAngles& angles) const;
  std::array<JointAxis, leg_joints> axes_at(const LegAngles& angles) const;
  /// Returns the angles that put the sole there, with the knee forward. When the sole is out of reach, the leg is
  /// straight and points there. The hip must be above the sole, with less than a quarter turn of hip roll.
  LegAngles angles_for(const Frame& sole) const;

 private:
  /// Returns the frame behind each joint, in the frame behind the previous joint.
  std::array<Frame, leg_joints> links_at(const LegAngles& angles) const;
  Vector mirrored(const Vector& v) const { return {v.x, side_ * v.y, v.z}; }

  LegDimensions d_;
  double side_;
};

}  // namespace walking
