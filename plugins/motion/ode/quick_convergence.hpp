// SPDX-License-Identifier: MIT
// Checks whether ODE's iterative solver holds the joints of a robot.
#pragma once

#include "plugins/motion/common/multibody/robot_model.hpp"

namespace muro::ode {

/// Returns the remaining part of the speeds that violate a robot's joints, after `iterations` of successive
/// over-relaxation as in dWorldQuickStep. It is the root of the energy ratio: 0 when the joints hold, 1 when nothing is
/// gained, infinite when it diverges. It is measured on bodies at the start with different given velocities. Contacts
/// do not count. [setup]
double unsolved_part(const multibody::RobotModel& model, int iterations);

}  // namespace muro::ode
