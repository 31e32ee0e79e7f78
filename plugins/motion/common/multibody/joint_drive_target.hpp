// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/motion/common/position_drive/position_target.hpp"
#include "robot_model.hpp"
#include "robot_state.hpp"

namespace muro::multibody {

/// Returns the task of a joint's drive in a step, within the limits of the model. `joint`: state of the joint;
/// `target`: the value that the drive mode follows, null when it follows nothing. Not for joints in mode position.
DriveTarget drive_target_of(const RigidBody& body, const JointState& joint, const double* target);

/// Reduces an effort (N m or N) so that it pushes the joint no faster than the model's speed limit within a step of
/// `dt` (s). `inertia` (kg m^2 or kg): inertia of the joint in free motion.
double within_speed_limit(double effort, const RigidBody& body, const JointState& joint, double inertia, double dt);
/// Whether within_speed_limit() is needed: the effort pushes a joint that is near the limit.
bool nears_speed_limit(double effort, const RigidBody& body, const JointState& joint);

/// Returns the task of a mimic joint's drive. `leader`: state of the joint that it mimics; `gain`: 1/s. `is_coupled`:
/// the engine couples both joints by a constraint, and the only other effort on the mimic joint is its friction.
/// Otherwise a drive makes it follow, as strong as the model says.
DriveTarget mimic_target(const RigidBody& body, const JointState& joint, const JointState& leader, double gain,
                         bool is_coupled);

/// Returns the task of a drive in mode position. At the end of the step of `dt` (s) the joint shall be at `reference`,
/// within limits. `inertia` (kg m^2 or kg): inertia of the joint in free motion; it shows whether the drive would pass
/// the speed limit.
DriveTarget position_drive_target(const RigidBody& body, const JointState& joint, const PdGains& gains,
                                  const Reference& reference, double inertia, double dt);

}  // namespace muro::multibody
