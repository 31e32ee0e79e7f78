// SPDX-License-Identifier: MIT
// Keeps a robot on two wheels upright by its gyro, its accelerometer and the encoders of its wheels.
//
// A complementary filter estimates the pitch and learns the bias of the gyro (Mahony, Hamel and Pflimlin, Nonlinear
// Complementary Filters on the Special Orthogonal Group, IEEE Trans. Automatic Control 53, 2008; here about one axis).
// Wheels are driven by speed: the acceleration of the axle is linear in pitch, its rate, speed and position, with the
// poles of the loop at -6, -5, -1.5 and -1 /s (README.md). Frames follow ROS REP-103.
#include <algorithm>
#include <cmath>

#include "muro_controller.hpp"
#include "muro_elementary.h"  // sines and the like with equal bits on every machine

namespace {

using namespace muro::controller;

constexpr double wheel_radius = 0.08;  // m
constexpr double by_pitch = 22.3, by_rate = 3.21, by_speed = 1.94, by_position = 0.955;
constexpr double filter_gain = 1;       // 1/s: how fast the accelerometer corrects the pitch
constexpr double max_acceleration = 6;  // m/s^2
constexpr double max_away = 0.5;        // m: greatest error of position for the controller
constexpr double fallen = 1;            // rad: from this pitch on the wheels stand still

enum Input { angular_velocity, linear_acceleration, wheels };
enum Output { wheel_speeds, estimated_pitch, estimated_bias };
enum Tunable { bias_gain };

class Balance {
 public:
  static constexpr const char* name = "balance";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Balances on two wheels by gyro, accelerometer and encoders";
  static constexpr muro_port inputs[] = {
      {"angular_velocity", "rad/s", 3, 0}, {"linear_acceleration", "m/s^2", 3, 0}, {"encoder.position", "rad", 2, 0}};
  static constexpr muro_port outputs[] = {{"joint.velocity.target", "rad/s", 2, 0},
                                          {"balance.pitch", "rad", 1, MURO_PORT_OWN},
                                          {"balance.gyro_bias", "rad/s", 1, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"bias_gain", "1/s^2", 0.1, 0, 10, "how fast the bias of the gyro is learnt; 0: it is believed"}};
  static constexpr std::size_t save_size = 5 * sizeof(double);

  explicit Balance(const Setup&) {}

  void step(const Step& now) {
    State& s = state_;
    const auto rate = now.input(angular_velocity), force = now.input(linear_acceleration), turned = now.input(wheels);
    if (now.index() == 0) s.pitch = muro_atan2(-force[0], force[2]);
    estimate(rate[1], force, now.period(), now.tunable(bias_gain));
    const double pitch_rate = rate[1] - s.bias;
    // the wheels turn relative to the body, which turns, too
    const double position = wheel_radius * (0.5 * (turned[0] + turned[1]) + s.pitch);
    if (now.index() == 0) s.start = position;
    const double away = std::clamp(position - s.start, -max_away, max_away);
    const double wanted = by_pitch * s.pitch + by_rate * pitch_rate + by_speed * s.speed + by_position * away;
    s.acceleration = std::clamp(wanted, -max_acceleration, max_acceleration);
    s.speed += s.acceleration * now.period();
    if (std::abs(s.pitch) > fallen) s.acceleration = s.speed = 0;
    for (double& target : now.output(wheel_speeds)) target = s.speed / wheel_radius - pitch_rate;
    now.output(estimated_pitch)[0] = s.pitch;
    now.output(estimated_bias)[0] = s.bias;
  }

  void save(Saver& to) const { to.put(state_); }
  void load(Loader& from) { state_ = from.get<State>(); }

 private:
  /// Estimates pitch and bias. The specific force without the acceleration of the axle shows the pitch.
  void estimate(double rate, std::span<const double> force, double dt, double gain_of_bias) {
    State& s = state_;
    const double along = force[0] - muro_cos(s.pitch) * s.acceleration,
                 up = force[2] - muro_sin(s.pitch) * s.acceleration;
    const double seen = muro_atan2(-along, up), error = seen - s.pitch;
    s.pitch += (rate - s.bias + filter_gain * error) * dt;
    s.bias -= gain_of_bias * error * dt;
  }

  struct State {
    double pitch = 0, bias = 0;          // rad, rad/s: estimates
    double speed = 0, acceleration = 0;  // m/s, m/s^2: of the axle, as commanded
    double start = 0;                    // m
  };
  State state_;
};

}  // namespace

MURO_CONTROLLER(Balance)
