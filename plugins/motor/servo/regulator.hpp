// SPDX-License-Identifier: MIT
// The digital controller of a servo: what it reads, and what effort it asks for.
#pragma once

#include <algorithm>
#include <cmath>

namespace muro::servo {

/// What bounds an effort, N m or N. least <= most.
struct Bounds {
  double least = 0, most = 0;
};

struct Regulator {
  bool follows_velocity = false;  ///< else a position
  double stiffness = 0;           ///< N m/rad
  double damping = 0;             ///< N m s/rad
  double integral = 0;            ///< N m/(rad s), of the position's error

  /// The effort (N m or N) for `target` within `bounds`. `kept`: the effort of the integral so far.
  ///
  /// Position: stiffness e + kept - damping v, with kept' = integral e. Velocity: damping e + kept, with
  /// kept' = stiffness e. The integral rests while the effort is at a bound that the error asks to pass, and is never
  /// more than the bounds (conditional integration: Astrom and Hagglund, PID Controllers, Section 3.5).
  double effort(double target, double position, double velocity, const Bounds& bounds, double& kept, double dt) const {
    const double error = target - (follows_velocity ? velocity : position);
    const double at_once = follows_velocity ? damping * error : stiffness * error - damping * velocity;
    const double wanted = at_once + kept;
    const double allowed = std::clamp(wanted, bounds.least, bounds.most);
    const double gain = follows_velocity ? stiffness : integral;
    if (gain > 0 && (wanted == allowed || (wanted > allowed) != (error > 0)))
      kept = std::clamp(kept + gain * error * dt, std::min(bounds.least, 0.0), std::max(bounds.most, 0.0));
    return allowed;
  }
};

/// An encoder with a finite number of steps; speed by differences of its readings.
struct Encoder {
  double resolution = 0;  ///< rad or m a step; 0: exact
  double filter = 0;      ///< s, time constant of the speed; 0: none

  double reading(double position) const {
    return resolution > 0 ? std::round(position / resolution) * resolution : position;
  }
  /// The speed as the controller sees it; `last`, `speed`: what it saw in the run before. `exact`: the true one.
  double seen_speed(double now, double last, double speed, double exact, double dt) const {
    const double raw = resolution > 0 ? (now - last) / dt : exact;
    return speed + (raw - speed) * (dt / (filter + dt));
  }
};

}  // namespace muro::servo
