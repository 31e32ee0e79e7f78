// SPDX-License-Identifier: MIT
#pragma once

#include "robot_model.hpp"
#include "robot_state.hpp"

namespace muro::multibody {

/// Computes the states of all bodies from the state of the base and the joints. `out`: one per body.
void forward_kinematics(const RobotModel& model, const RobotState& state, std::span<BodyState> out);

}  // namespace muro::multibody
