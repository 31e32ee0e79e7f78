// SPDX-License-Identifier: MIT
// A vehicle with left and right wheels and a drive, for tests.
#pragma once

#include "tests/support/wheeled_robot.hpp"

namespace muro::test {

/// A vehicle with a drive that runs at 100 Hz and, unless `motion` is empty, a motion.
struct SideWheelVehicle : Scene {
  const RobotView& robot;
  SideWheelVehicle(const RobotTree& tree, const std::string& drive, std::map<std::string, ParameterInput> settings,
                   const std::string& motion)
      : robot(add("rover", tree)) {
    if (!motion.empty()) use(motion, 100, all_robots());
    use(drive, 100, all_robots(), std::move(settings));
    build();
  }
  void command(double forward, double yaw_rate) {
    world().value(robot.base(), keys::command_twist) = {{forward, 0, 0}, {0, 0, yaw_rate}};
    run_for(0.01);
  }
  double target(const std::string& wheel) {
    return world().value("rover/" + wheel + "_joint", keys::joint_velocity_target);
  }
};

}  // namespace muro::test
