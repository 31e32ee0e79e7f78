// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/common/position_drive/position_target.hpp"
#include "robot_model.hpp"
#include "robot_state.hpp"

namespace muro::multibody {

/// What the drive of a body's joint is to do in a step, within the limits of the model. `joint`: its state; `leader`:
/// that of the joint which it mimics, null for none; `target`: what its drive mode follows, null where it follows
/// nothing; `gain_of_mimics`: 1/s. Not for joints in mode position without a leader.
DriveTarget drive_target_of(const RigidBody& body, const JointState& joint, const JointState* leader,
                            const double* target, double gain_of_mimics);

/// The same of a joint in mode position, in a step of `dt` (s) at whose end it is to be at `reference`, within limits.
/// `inertia` (kg m^2 or kg): of the joint in free motion, by which it is seen whether the drive would pass the limit of
/// speed.
DriveTarget position_drive_target(const RigidBody& body, const JointState& joint, const PdGains& gains,
                                  const Reference& reference, double inertia, double dt);

}  // namespace muro::multibody
