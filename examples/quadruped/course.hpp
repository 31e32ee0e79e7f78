// SPDX-License-Identifier: MIT
// Targets of the body: speed, heading and height, which follow commands evenly.
#pragma once

#include <algorithm>

#include "../common/vector.hpp"
#include "model.hpp"
#include "placement.hpp"

namespace quadruped {

struct Course {
  Command wanted;      ///< command, approached with limited acceleration
  Vector trim;         ///< m/s: added to the command when the body has been too slow for long
  double heading = 0;  ///< rad
  double height = 0;   ///< m: of the origin of the body above the ground

  /// `trots`: when false, the robot stands, whatever is commanded; `velocity`: of the body, m/s, level frame; `dt`: s.
  void follow(const Model& model, const Command& told, bool trots, const Vector& velocity, double dt) {
    const Command go = trots ? told : Command{};
    height = nearer(height, model.height, model.climb * dt);
    wanted.forward = nearer(wanted.forward, go.forward, model.acceleration * dt);
    wanted.left = nearer(wanted.left, go.left, model.acceleration * dt);
    wanted.turn = nearer(wanted.turn, go.turn, model.turn_acceleration * dt);
    heading += wanted.turn * dt;
    if (!trots) {
      trim = {};
      return;
    }
    // the trim must not grow by a push, to which the feet react on their own
    const auto missing = [](double is, double by_command) {
      return std::clamp(by_command - is, -slow_error, slow_error);
    };
    const double gain = model.gains.trim * dt;
    trim.x = std::clamp(trim.x + gain * missing(velocity.x, wanted.forward), -most_trim, most_trim);
    trim.y = std::clamp(trim.y + gain * missing(velocity.y, wanted.left), -most_trim, most_trim);
  }
  /// Returns the target of the speed.
  Command aim() const { return {wanted.forward + trim.x, wanted.left + trim.y, wanted.turn}; }

 private:
  static double nearer(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

  static constexpr double most_trim = 0.2, slow_error = 0.1;  // m/s
};

}  // namespace quadruped
