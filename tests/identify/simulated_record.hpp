// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>

#include "host/tools/identify/motor_simulation.hpp"
#include "muro/base/random.hpp"

namespace muro::test {

/// Records of a motor with a pendulum, as on a real bench: positions have noise of `sigma` (rad).
struct SimulatedBench {
  host::MotorEstimate motor;  ///< `gain`: for each unit of the P gain
  host::BenchLoad load{.mass = 0.49, .length = 0.1};
  double supply_voltage = 7.4, sigma = 1e-3, period = 0.005, duration = 6;
  std::uint64_t seed = 1;

  host::MotorRecord record(double p_gain, const std::function<double(double)>& goal,
                           double torque_off_from = 1e9) const {
    host::MotorRecord r;
    r.name = "simulated";
    r.p_gain = p_gain;
    r.load = load;
    const Random random(seed, std::uint64_t(1e3 * p_gain), 0);
    double q = 0, w = 0;
    constexpr int substeps = 50;
    const double dt = period / substeps, inertia = load.moment_of_inertia() + motor.motor.armature;
    for (int i = 0; i * period <= duration; ++i) {
      const double t = i * period;
      host::RecordSample s;
      s.time = t;
      s.goal = goal(t);
      s.supply_voltage = supply_voltage * (1 + 0.05 * std::sin(3 * t));
      s.torque_enable = t < torque_off_from;
      s.position = q + sigma * random.normal(std::uint32_t(i));
      r.samples.push_back(s);
      for (int k = 0; k < substeps; ++k) {
        const double load_torque = -load.gravity_torque() * std::sin(q + motor.offset);
        const double duty =
            std::clamp(p_gain * motor.motor.gain * (s.goal - q), -motor.motor.duty_limit, motor.motor.duty_limit);
        const double torque = s.torque_enable ? motor.motor.torque(duty * s.supply_voltage, w) : 0;
        const double v = motor::next_velocity(w, torque + load_torque,
                                              motor.motor.friction.budget(w, torque, load_torque), inertia, dt);
        q += 0.5 * dt * (w + v), w = v;
      }
    }
    return r;
  }

  /// Returns four records with two P gains; in one the torque is switched off.
  std::vector<host::MotorRecord> records(double low_gain, double high_gain) const {
    const auto wave = [](double t) { return M_PI / 2 * std::sin(t) + 0.5 * std::sin(5 * t) * std::sin(2 * t); };
    const auto chirp = [](double t) { return std::sin(t * t); };
    const auto lift = [](double t) { return -M_PI / 2 * std::min(t / 2, 1.0); };
    return {record(low_gain, wave), record(high_gain, wave), record(high_gain, chirp), record(high_gain, lift, 2)};
  }
};

}  // namespace muro::test
