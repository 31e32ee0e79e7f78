// SPDX-License-Identifier: MIT
// A DC motor behind a gear, with friction: what simulates servos and what identifies them from recordings share it.
// All figures are those at the output of the gear. Models M1 to M4: Duclusaud, Passault, Padois and Ly, Extended
// friction models for the physics simulation of servo actuators, arXiv 2410.08650, Section III.
#pragma once

#include <algorithm>
#include <cmath>

#include "muro/base/elementary.hpp"

namespace muro::motor {

/// How much friction there can be, in a motor and its gear. What is 0 has no part in it: M1 has `coulomb` and
/// `viscous`; M2 `stribeck`, too; M3 `load` instead; M4 all.
struct FrictionModel {
  double coulomb = 0;            ///< N m
  double viscous = 0;            ///< N m s/rad
  double stribeck = 0;           ///< N m: more at rest, less and less with speed
  double stribeck_velocity = 1;  ///< rad/s, above 0: at which exp(-1) of it is left
  double stribeck_exponent = 1;  ///< above 0
  double load = 0;               ///< by the torque between motor and load
  double load_stribeck = 0;      ///< the same, less and less with speed

  bool depends_on_load() const { return load > 0 || load_stribeck > 0; }
  bool has_stribeck() const { return stribeck > 0 || load_stribeck > 0; }

  /// The largest friction (N m) at `velocity` (rad/s), with `motor_torque` and `load_torque` (N m, both as they act on
  /// the output) on the two sides of the gear. While a motor holds a load they are opposite.
  double budget(double velocity, double motor_torque, double load_torque) const {
    const double speed = std::abs(velocity), gear_torque = std::abs(motor_torque - load_torque);
    double sum = coulomb + load * gear_torque + viscous * speed;
    if (has_stribeck()) {
      const double share = elementary::exp(-elementary::pow(speed / stribeck_velocity, stribeck_exponent));
      sum += share * (stribeck + load_stribeck * gear_torque);
    }
    return sum;
  }
};

/// What is left of `momentum` (N m s) when friction has taken at most `most` >= 0 of it: 0 exactly where that suffices.
inline double beyond_friction(double momentum, double most) {
  return momentum > 0 ? std::max(momentum - most, 0.0) : std::min(momentum + most, 0.0);
}

/// The motor with the amplifier of a digital servo.
struct MotorModel {
  double kt = 1;          ///< N m/A, or V s/rad
  double resistance = 1;  ///< Ohm
  double armature = 0;    ///< kg m^2: of the rotor, as the output feels it
  double gain = 0;        ///< 1/rad: duty by error of position, all of the firmware's factors in one
  double duty_limit = 1;  ///< the largest duty, 0 .. 1
  FrictionModel friction;

  /// Nm s/rad: what the motor brakes by speed while both ends of its coil are held.
  double back_emf_damping() const { return kt * kt / resistance; }
  /// The duty, -1 .. 1, with which the servo answers to `error` (rad) of its position.
  double duty(double error) const { return std::clamp(gain * error, -duty_limit, duty_limit); }
  /// N m: of the coil at `voltage` (V) and `velocity` (rad/s).
  double torque(double voltage, double velocity) const { return (voltage - kt * velocity) * kt / resistance; }

  /// rad/s: without load, at `voltage` >= 0 (V); M1 alone.
  double no_load_speed(double voltage) const {
    return std::max(kt * voltage / resistance - friction.coulomb, 0.0) / (back_emf_damping() + friction.viscous);
  }
  /// N m: what it gives at standstill, at `voltage` >= 0 (V); M1 alone.
  double stall_torque(double voltage) const { return std::max(kt * voltage / resistance - friction.coulomb, 0.0); }
  /// s: of a step of the voltage on `inertia` (kg m^2) and its own; M1 alone.
  double time_constant(double inertia) const { return (inertia + armature) / (back_emf_damping() + friction.viscous); }
};

/// The velocity (rad/s) after `dt` (s). Friction is a budget: it is the torque that would stop `inertia` (kg m^2, with
/// the armature) within the step, but at most `budget` (N m). So what it can hold does not move at all.
inline double next_velocity(double velocity, double torque, double budget, double inertia, double dt) {
  return beyond_friction(inertia * velocity + torque * dt, budget * dt) / inertia;
}

/// What a load does, found from how the joint moves: for friction that depends on it where nothing tells it.
struct LoadObserver {
  /// The torque (N m) of the load in the last step of `dt` (s). `change`: of the velocity in it (rad/s); `velocity`: at
  /// its end; `torque` and `budget`: of motor and friction; `inertia`: kg m^2, with the armature; `before`: what this
  /// returned the last time. While the joint sticks, friction may hide what it can hold; the torque is then the nearest
  /// one to `before` that is possible.
  static double load(double velocity, double change, double torque, double budget, double inertia, double before,
                     double dt) {
    const double with_friction = inertia * change / dt - torque;
    if (velocity > 0) return with_friction + budget;
    if (velocity < 0) return with_friction - budget;
    return std::clamp(before, with_friction - budget, with_friction + budget);
  }
};

}  // namespace muro::motor
