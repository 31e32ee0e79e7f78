// SPDX-License-Identifier: MIT
// A leg of six joints: hip yaw, roll and pitch, knee, ankle pitch and roll; where its sole is, and the angles that put
// it somewhere, in closed form.
#pragma once

#include <array>

#include "vectors.hpp"

namespace walking {

/// Dimensions of the left leg in m; those of the right one are mirrored at y = 0. The axes of hip yaw (z) and hip roll
/// (x) meet in one point; those of hip roll and pitch, and those of ankle pitch and roll, may pass each other. The
/// shares of offsets along an axis do not matter and have no number: all of them along the pitch axes make `leg_y`.
struct LegDimensions {
  Vector hip;              ///< where the axes of yaw and roll meet, in the frame of the trunk
  double hip_pitch_x = 0;  ///< axis of hip pitch ahead of that point, with hip roll at 0
  double hip_pitch_z = 0;  ///< and above it
  double leg_y = 0;        ///< axis of ankle roll outwards of that of hip roll, both at 0
  double thigh = 0.1;      ///< from hip pitch down to the knee
  double knee_x = 0;       ///< knee ahead of the hip's pitch axis when that is at 0
  double shin = 0.1;       ///< from the knee down to ankle pitch
  double ankle_x = 0;      ///< ankle ahead of the knee, with all angles at 0
  double ankle_z = 0;      ///< axis of ankle roll below that of ankle pitch
  double sole_x = 0;       ///< centre of the sole ahead of ankle pitch
  double sole_y = 0;       ///< and outwards of the axis of ankle roll
  double sole_z = 0.03;    ///< and below it
};

enum LegJoint { hip_yaw, hip_roll, hip_pitch, knee, ankle_pitch, ankle_roll, leg_joints };
using LegAngles = std::array<double, leg_joints>;  ///< rad, in the positive sense of REP-103: a bent knee is above 0

/// Where a joint is and about what it turns, in the frame of the trunk.
struct JointAxis {
  Vector origin, axis;
};

class Leg {
 public:
  /// `side`: 1 for the left leg, -1 for the right one.
  Leg(const LegDimensions& dimensions, double side) : d_(dimensions), side_(side) {}

  double side() const { return side_; }
  /// m: from hip pitch to ankle pitch of the straight leg.
  double length() const;
  /// The sole's frame in that of the trunk, origin in its centre, z up.
  Frame sole_at(const LegAngles& angles) const;
  std::array<JointAxis, leg_joints> axes_at(const LegAngles& angles) const;
  /// The angles that put the sole there, with the knee forward. Out of reach, the leg is straight and points there.
  /// The hip is taken to be above the sole, with less than a quarter turn of hip roll.
  LegAngles angles_for(const Frame& sole) const;

 private:
  /// The frames behind each joint, in that of the one before it.
  std::array<Frame, leg_joints> links_at(const LegAngles& angles) const;
  Vector mirrored(const Vector& v) const { return {v.x, side_ * v.y, v.z}; }

  LegDimensions d_;
  double side_;
};

}  // namespace walking
