// SPDX-License-Identifier: MIT
// A servo and its load as they move by themselves from the first sample of a record on, under its commands.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "host/tools/identify/record.hpp"
#include "muro/base/motor_model.hpp"

namespace muro::host {

/// What identification finds.
struct MotorEstimate {
  motor::MotorModel motor;             ///< `gain`: for each unit of the P gain
  double offset = 0;                   ///< rad: what the record's positions lack of the pendulum's angle
  double delay = 0;                    ///< s, from the recorded command to what the servo does
  double temperature_coefficient = 0;  ///< 1/K: of the resistance, from `reference_temperature` on
  double reference_temperature = 25;   ///< degrees Celsius

  /// Ohm, at a recorded temperature (degrees Celsius).
  double resistance_at(double temperature) const {
    constexpr double least = 0.1;  // of that at the reference
    return motor.resistance * std::max(1 + temperature_coefficient * (temperature - reference_temperature), least);
  }
};

/// A part of a record without gaps, as the simulation takes it: the interval from each sample to the next in `steps`
/// equal steps. Of a delayed goal that changes within an interval it has the mean.
struct RecordSegment {
  std::size_t first = 0;  ///< sample of the record
  double initial_velocity = 0;
  struct Interval {
    double goal, supply_voltage, dt;  ///< s, of a step
    std::int32_t steps;
    bool torque_enable;
    double temperature;  ///< degrees Celsius, where the record has it
    double position;     ///< rad, recorded at its end
  };
  double initial_position = 0;
  std::vector<Interval> intervals;
};

/// A record made ready. Steps take at most `longest_step` (s). Where more than `gap_factor` times the usual period, and
/// more than 0.05 s, lie between two samples, the simulation begins anew.
struct PreparedRecord {
  double p_gain = 0;
  double duty_gain = 0, duty_limit = 0;  ///< of the record, or 0: those of the estimate
  bool has_temperature = false;
  BenchLoad load;
  std::vector<RecordSegment> segments;
  std::size_t sample_count = 0;  ///< that are compared
  std::size_t gap_count = 0;
};
/// `delay` (s): of goals; the torque's enable and the supply have none, as in motor.servo.
PreparedRecord prepare(const MotorRecord& record, double longest_step, double delay = 0);

/// Simulates a segment of `record`; `visit(position error, interval)` at the end of each interval. Torques and
/// friction's budget are those in the middle of a step, with the velocity extrapolated there: of second order, as the
/// recorded sampling is coarse. Friction itself is that of motor::next_velocity.
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

/// How far the simulation is from a record.
struct RecordError {
  double mean = 0;     ///< rad, of |error|
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
