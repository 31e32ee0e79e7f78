// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "ode_robot.hpp"

namespace muro::ode {

/// ODE corrects overlaps by velocities, which would last: what lands would rebound. So a step in which contacts push
/// bodies out is taken twice, with and without that: positions are those of the first time, velocities and forces
/// those of the second. Only robots that are pushed, or touch some that are, take part in the second.
class SplitStep {
 public:
  void resize(const std::deque<OdeRobot>& robots);
  /// Before the step: keeps the state of all bodies.
  void keep_start(const std::deque<OdeRobot>& robots);
  /// After it: whether some contact has pushed out what overlaps, and which robots it concerns.
  bool find_pushed(const std::deque<OdeRobot>& robots, std::span<const FoundContact> contacts);
  bool is_pushed(const FoundContact& contact) const {
    return pushed_[std::size_t(contact.first->robot)] ||
           (contact.second->robot >= 0 && pushed_[std::size_t(contact.second->robot)]);
  }
  /// Sets these robots back, and leaves the others out of what follows.
  void begin_again(const std::deque<OdeRobot>& robots);
  /// Places bodies where the first time has brought them.
  void end(const std::deque<OdeRobot>& robots);

 private:
  struct Body {
    dVector3 position, velocity, spin, force, torque;
    dQuaternion orientation;
  };

  std::vector<Body> bodies_;  ///< of all robots: where the step begins, then where it ends
  std::vector<char> pushed_;  ///< of each robot
};

}  // namespace muro::ode
