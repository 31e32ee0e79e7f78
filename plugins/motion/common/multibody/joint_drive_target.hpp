// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/motion/common/position_drive/position_target.hpp"
#include "robot_model.hpp"
#include "robot_state.hpp"

namespace muro::multibody {

/// What the drive of a body's joint is to do in a step, within the limits of the model. `joint`: its state; `target`:
/// what its drive mode follows, null where it follows nothing. Not for joints in mode position.
DriveTarget drive_target_of(const RigidBody& body, const JointState& joint, const double* target);

/// What of an effort (N m or N) pushes the joint no faster than the model's limit of speed within a step of `dt` (s).
/// `inertia` (kg m^2 or kg): of the joint in free motion.
double within_speed_limit(double effort, const RigidBody& body, const JointState& joint, double inertia, double dt);
/// Whether that is to be asked: the effort pushes a joint that is near the limit.
bool nears_speed_limit(double effort, const RigidBody& body, const JointState& joint);

/// The same of a mimic joint. `leader`: the state of the joint which it mimics; `gain`: 1/s; `is_coupled`: the engine
/// holds the two together by a constraint, and what moves the mimic joint beside that is its friction; else it has a
/// drive that follows, as strong as the model says.
DriveTarget mimic_target(const RigidBody& body, const JointState& joint, const JointState& leader, double gain,
                         bool is_coupled);

/// The same of a joint in mode position, in a step of `dt` (s) at whose end it is to be at `reference`, within limits.
/// `inertia` (kg m^2 or kg): of the joint in free motion, by which it is seen whether the drive would pass the limit of
/// speed.
DriveTarget position_drive_target(const RigidBody& body, const JointState& joint, const PdGains& gains,
                                  const Reference& reference, double inertia, double dt);

}  // namespace muro::multibody
