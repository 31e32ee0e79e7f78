// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/simulation.hpp"
#include "host/scenario/scenario.hpp"
#include "host/scenario/start_pose.hpp"

namespace muro::host {

/// Sets the velocity of a robot and the positions of its joints at the start.
void set_initial_state(World& world, const RobotTemplate& t, const RobotView& robot, const StartPose& start);

/// Returns the name of a robot's object without the robot's name: "laser_link".
std::string name_within(const World& world, const RobotView& robot, ObjectId object);

}  // namespace muro::host
