// SPDX-License-Identifier: MIT
// Simulation of a servo and its load from the first sample of a record on, under its commands.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "host/tools/identify/record.hpp"
#include "muro/base/motor_model.hpp"

namespace muro::host {

/// Results of an identification.
struct MotorEstimate {
  motor::MotorModel motor;             ///< `gain`: for each unit of the P gain
  double offset = 0;                   ///< rad: angle of the pendulum minus position in the record
  double delay = 0;                    ///< s, from the recorded command to the reaction of the servo
  double temperature_coefficient = 0;  ///< 1/K: change of the resistance, from `reference_temperature` on
  double reference_temperature = 25;   ///< degrees Celsius

  /// Resistance (Ohm) at a recorded temperature (degrees Celsius).
  double resistance_at(double temperature) const {
    constexpr double least = 0.1;  // relative to that at the reference
    return motor.resistance * std::max(1 + temperature_coefficient * (temperature - reference_temperature), least);
  }
};

/// A part of a record without gaps, prepared for the simulation: the interval from each sample to the next is divided
/// into `steps` equal steps. A delayed goal that changes within an interval is replaced by its mean there.
struct RecordSegment {
  std::size_t first = 0;  ///< index of the sample in the record
  double initial_velocity = 0;
  struct Interval {
    double goal, supply_voltage, dt;  ///< s, of one step
    std::int32_t steps;
    bool torque_enable;
    double temperature;  ///< degrees Celsius, if the record has it
    double position;     ///< rad, recorded at the end of the interval
  };
  double initial_position = 0;
  std::vector<Interval> intervals;
};

/// A prepared record. Steps take at most `longest_step` (s). When two samples are apart by more than `gap_factor` times
/// the usual period, and by more than 0.05 s, the simulation begins anew.
struct PreparedRecord {
  double p_gain = 0;
  double duty_gain = 0, duty_limit = 0;  ///< of the record; 0: those of the estimate
  bool has_temperature = false;
  BenchLoad load;
  std::vector<RecordSegment> segments;
  std::size_t sample_count = 0;  ///< number of compared samples
  std::size_t gap_count = 0;
};
/// Prepares a record. `delay` (s): delay of goals; the torque's enable and the supply have none, as in motor.servo.
PreparedRecord prepare(const MotorRecord& record, double longest_step, double delay = 0);

/// Simulates a segment of `record`; calls `visit(position error, interval)` at the end of each interval. Torques and
/// the budget of friction are those in the middle of a step, with the velocity extrapolated to there. This is of second
/// order, because the recorded sampling is coarse. Friction itself is that of motor::next_velocity.
template <class Visit>
void simulate(const RecordSegment& segment, const PreparedRecord& record, const MotorEstimate& e, const Visit& visit) {
  const motor::MotorModel& m = e.motor;
  const double gain = record.p_gain * (record.duty_gain > 0 ? record.duty_gain : m.gain);
  const double duty_limit = record.duty_limit > 0 ? record.duty_limit : m.duty_limit;
  const double inertia = record.load.moment_of_inertia() + m.armature;
  const double weight = record.load.gravity_torque();
  const bool by_temperature = e.temperature_coefficient != 0 && record.has_temperature;
  double q = segment.initial_position, w = segment.initial_velocity, before = w;
  for (const RecordSegment::Interval& interval : segment.intervals) {
    const double per_volt = m.kt / (by_temperature ? e.resistance_at(interval.temperature) : m.resistance);
    const double braking = by_temperature ? m.kt * per_volt : m.back_emf_damping();
    const double volts = interval.supply_voltage * per_volt, dt = interval.dt;
    for (std::int32_t k = 0; k < interval.steps; ++k) {
      const double middle = q + 0.5 * dt * w, extrapolated = w + 0.5 * (w - before);
      const double speed = extrapolated * w > 0 ? extrapolated : 0;
      const double load_torque = weight == 0 ? 0 : -weight * elementary::sin(middle + e.offset);
      double torque = 0;
      if (interval.torque_enable)
        torque = std::clamp(gain * (interval.goal - middle), -duty_limit, duty_limit) * volts - braking * speed;
      const double budget = m.friction.budget(speed, torque, load_torque);
      before = w;
      w = motor::next_velocity(w, torque + load_torque, budget, inertia, dt);
      q += 0.5 * dt * (before + w);
    }
    visit(q - interval.position, interval);
  }
}

/// Error of the simulation of a record.
struct RecordError {
  double mean = 0;     ///< rad, mean of |error|
  double rms = 0;      ///< rad
  double largest = 0;  ///< rad
};
RecordError error_of(const PreparedRecord& record, const MotorEstimate& estimate);

/// The errors (rad) sample by sample, with their times (s).
struct Residuals {
  std::vector<double> times, errors;
};
Residuals residuals_of(const PreparedRecord& record, const MotorRecord& times, const MotorEstimate& estimate);

}  // namespace muro::host
