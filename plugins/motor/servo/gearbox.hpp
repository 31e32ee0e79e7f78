// SPDX-License-Identifier: MIT
// The rotor of a servo as a body of its own, and the gearbox that couples it to the joint: elastic, with backlash,
// friction and losses. All values are those at the output.
#pragma once

#include <cmath>

#include "motor.hpp"

namespace muro::servo {

struct Rotor {
  double position = 0;  ///< rad or m
  double velocity = 0;  ///< rad/s or m/s
};

struct Gearbox {
  double rotor_inertia = 0;  ///< kg m^2 or kg; 0: none, the motor acts directly on the joint
  double joint_inertia = 0;  ///< kg m^2 or kg: inertia that the joint moves, approximate
  double friction = 0;       ///< N m or N, Coulomb
  double loss = 0;           ///< friction / transmitted effort: 1 / efficiency - 1
  double viscous = 0;        ///< N m s/rad or N s/m
  double backlash = 0;       ///< rad or m, from flank to flank
  double stiffness = 0;      ///< N m/rad or N/m; 0: as stiff as the rate allows

  /// Returns the reduced inertia of rotor and joint against each other.
  double reduced_inertia() const { return rotor_inertia * joint_inertia / (rotor_inertia + joint_inertia); }
  /// Returns the greatest stiffness of the spring, N m/rad or N/m, for the period `dt` (s). The spring then swings once
  /// in 25 periods, so the joint may be four times lighter than `joint_inertia` and stay stable.
  double max_stiffness(double dt) const { return 0.0625 * reduced_inertia() / (dt * dt); }

  /// Returns the effort on the joint (N m or N), constant over the step `dt`; the rotor gets the opposite effort.
  ///
  /// A dead zone, then a spring and a damper that do not pull (Nordin and Gutman, Controlling mechanical systems with
  /// backlash - a survey, Automatica 38, 2002, Section 2). The damper is critical for the two bodies in steps of `dt`:
  /// with a = k dt^2 / m and b = d dt / m, a matrix with the trace 2 - a/2 - b and the determinant 1 - b + a/2 advances
  /// deflection and its speed. Its two eigenvalues are equal, 1 - sqrt(a), for b = 2 sqrt(a) - a/2.
  double effort(const Rotor& rotor, double position, double velocity, double dt) const {
    const double twist = rotor.position - position;
    const double deflection = twist > 0.5 * backlash ? twist - 0.5 * backlash : std::min(twist + 0.5 * backlash, 0.0);
    if (deflection == 0) return 0;
    const double mass = reduced_inertia(), max_k = max_stiffness(dt);
    const double k = stiffness > 0 ? std::min(stiffness, max_k) : max_k, a = k * dt * dt / mass;
    const double force = k * deflection + (2 * std::sqrt(a) - 0.5 * a) * mass / dt * (rotor.velocity - velocity);
    return deflection > 0 ? std::max(force, 0.0) : std::min(force, 0.0);
  }

  /// Advances the rotor by a step under the effort `wanted` of the controller, within the limits of the motor, and the
  /// reaction to the effort `to_joint`. Motor line, viscous and Coulomb friction are those of the end of the step, so
  /// none of them overshoots and the rotor sticks. Returns the motor's effort.
  double advance_rotor(Rotor& rotor, double wanted, const Motor& motor, double to_joint, double dt) const {
    const double max_friction = friction + loss * std::abs(to_joint);
    const auto speed = [&](double effort, double slope) {
      const double momentum = rotor_inertia * rotor.velocity + (effort - to_joint) * dt;
      const double max_loss = max_friction * dt;
      const double left = momentum > 0 ? std::max(momentum - max_loss, 0.0) : std::min(momentum + max_loss, 0.0);
      return left / (rotor_inertia + (viscous + slope) * dt);
    };
    double effort = std::clamp(wanted, -motor.max_effort, motor.max_effort), v = speed(effort, 0);
    for (const double sign : {1.0, -1.0}) {
      if (sign * effort <= motor.stall - motor.slope * sign * v) continue;
      v = speed(sign * motor.stall, motor.slope);
      effort = sign * motor.stall - motor.slope * v;
      if (std::abs(effort) > motor.max_effort) effort = std::copysign(motor.max_effort, effort), v = speed(effort, 0);
    }
    rotor.position += 0.5 * dt * (rotor.velocity + v);
    rotor.velocity = v;
    return effort;
  }
};

}  // namespace muro::servo
