// SPDX-License-Identifier: MIT
// A DC motor with a gear and friction. The simulation of servos and their identification from recordings share it. All
// values are those at the output of the gear. Models M1 to M4: Duclusaud, Passault, Padois and Ly, Extended friction
// models for the physics simulation of servo actuators, arXiv 2410.08650, Section III.
#pragma once

#include <algorithm>
#include <cmath>

#include "muro/base/elementary.hpp"

namespace muro::motor {

/// Parameters of the largest friction in a motor and its gear. A term that is 0 has no effect: M1 has `coulomb` and
/// `viscous`; M2 also has `stribeck`; M3 has `load` instead; M4 has all.
struct FrictionModel {
  double coulomb = 0;            ///< N m
  double viscous = 0;            ///< N m s/rad
  double stribeck = 0;           ///< N m: additional friction at rest, which falls with speed
  double stribeck_velocity = 1;  ///< rad/s, above 0: speed at which exp(-1) of it remains
  double stribeck_exponent = 1;  ///< above 0
  double load = 0;               ///< times the torque between motor and load
  double load_stribeck = 0;      ///< additional part of `load` at rest, which falls with speed

  bool depends_on_load() const { return load > 0 || load_stribeck > 0; }
  bool has_stribeck() const { return stribeck > 0 || load_stribeck > 0; }

  /// The largest friction (N m) at `velocity` (rad/s). `motor_torque` and `load_torque` (N m, both as they act on the
  /// output) act on the two sides of the gear; they are opposite while a motor holds a load.
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

/// Remainder of `momentum` (N m s) after friction has removed at most `most` >= 0 of it: exactly 0 when that suffices.
inline double beyond_friction(double momentum, double most) {
  return momentum > 0 ? std::max(momentum - most, 0.0) : std::min(momentum + most, 0.0);
}

/// A motor with the amplifier of a digital servo.
struct MotorModel {
  double kt = 1;          ///< N m/A, or V s/rad
  double resistance = 1;  ///< Ohm
  double armature = 0;    ///< kg m^2: inertia of the rotor as the output feels it
  double gain = 0;        ///< 1/rad: duty by error of position, with all factors of the firmware
  double duty_limit = 1;  ///< the largest duty, 0 .. 1
  FrictionModel friction;

  /// N m s/rad: braking torque of the motor by speed while both ends of its coil are at fixed voltages.
  double back_emf_damping() const { return kt * kt / resistance; }
  /// Duty, -1 .. 1, of the servo at `error` (rad) of its position.
  double duty(double error) const { return std::clamp(gain * error, -duty_limit, duty_limit); }
  /// Torque (N m) of the coil at `voltage` (V) and `velocity` (rad/s).
  double torque(double voltage, double velocity) const { return (voltage - kt * velocity) * kt / resistance; }

  /// Speed (rad/s) without load at `voltage` >= 0 (V); for M1 only.
  double no_load_speed(double voltage) const {
    return std::max(kt * voltage / resistance - friction.coulomb, 0.0) / (back_emf_damping() + friction.viscous);
  }
  /// Torque (N m) at standstill, at `voltage` >= 0 (V); for M1 only.
  double stall_torque(double voltage) const { return std::max(kt * voltage / resistance - friction.coulomb, 0.0); }
  /// Time constant (s) of the response to a voltage step, with `inertia` (kg m^2) and the armature; for M1 only.
  double time_constant(double inertia) const { return (inertia + armature) / (back_emf_damping() + friction.viscous); }
};

/// Velocity (rad/s) after `dt` (s). Friction is a budget: it is the torque that would stop `inertia` (kg m^2, with the
/// armature) within the step, but at most `budget` (N m). So a joint that friction can hold does not move at all.
inline double next_velocity(double velocity, double torque, double budget, double inertia, double dt) {
  return beyond_friction(inertia * velocity + torque * dt, budget * dt) / inertia;
}

/// Estimates the load from the motion of the joint: for friction that depends on a load which is not measured.
struct LoadObserver {
  /// Torque (N m) of the load in the last step of `dt` (s). `change`: change of the velocity in it (rad/s); `velocity`:
  /// at its end; `torque` and `budget`: of motor and friction; `inertia`: kg m^2, with the armature; `before`: the
  /// result of the step before. While the joint sticks, friction may hide a torque that it can hold; the result is then
  /// the possible torque that is nearest to `before`.
  static double load(double velocity, double change, double torque, double budget, double inertia, double before,
                     double dt) {
    const double with_friction = inertia * change / dt - torque;
    if (velocity > 0) return with_friction + budget;
    if (velocity < 0) return with_friction - budget;
    return std::clamp(before, with_friction - budget, with_friction + budget);
  }
};

}  // namespace muro::motor
