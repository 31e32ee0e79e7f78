// SPDX-License-Identifier: MIT
#pragma once

#include "robot_model.hpp"
#include "robot_state.hpp"

namespace muro::multibody {

/// What the drive of a body's joint is to do in a step, within the limits of the model. `joint`: its state; `leader`:
/// that of the joint which it mimics, null for none; `target`: what its drive mode follows, null where it follows
/// nothing; `position_gain`: 1/s.
DriveTarget drive_target_of(const RigidBody& body, const JointState& joint, const JointState* leader,
                            const double* target, double position_gain);

}  // namespace muro::multibody
