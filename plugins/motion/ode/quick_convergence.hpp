// SPDX-License-Identifier: MIT
// Whether ODE's iterative solver holds the joints of a robot.
#pragma once

#include "plugins/motion/common/multibody/robot_model.hpp"

namespace muro::ode {

/// What `iterations` of successive over-relaxation, as in dWorldQuickStep, leave of the speeds that would part the
/// joints of a robot: the root of the part of their energy, 0 where they hold, 1 where nothing is gained, infinite
/// where it diverges. Found by doing it, on bodies at the start that have been thrown about. Contacts are not counted.
/// [setup]
double unsolved_part(const multibody::RobotModel& model, int iterations);

}  // namespace muro::ode
