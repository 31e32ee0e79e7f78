// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "ode_robot.hpp"

namespace muro::ode {

/// ODE corrects overlaps by velocities. These would remain, and a landing body would rebound. So a step in which
/// contacts push bodies out is made twice. The first pass has the correction and gives the positions. The second has
/// none and gives velocities and forces. Only robots that are pushed, or that touch pushed ones, take part in the
/// second.
class SplitStep {
 public:
  void resize(const std::deque<OdeRobot>& robots);
  /// Keeps the state of all bodies before the step.
  void keep_start(const std::deque<OdeRobot>& robots);
  /// Finds the robots that contacts have pushed out of an overlap. Returns whether there are any. Call it after the
  /// step.
  bool find_pushed(const std::deque<OdeRobot>& robots, std::span<const FoundContact> contacts);
  bool is_pushed(const FoundContact& contact) const {
    return pushed_[std::size_t(contact.first->robot)] ||
           (contact.second->robot >= 0 && pushed_[std::size_t(contact.second->robot)]);
  }
  /// Sets these robots back, and disables the others for the second pass.
  void begin_again(const std::deque<OdeRobot>& robots);
  /// Places bodies at the positions of the first pass.
  void end(const std::deque<OdeRobot>& robots);

 private:
  struct Body {
    dVector3 position, velocity, spin, force, torque;
    dQuaternion orientation;
  };

  std::vector<Body> bodies_;  ///< bodies of all robots at the start of the step, then at its end
  std::vector<char> pushed_;  ///< one per robot
};

}  // namespace muro::ode
