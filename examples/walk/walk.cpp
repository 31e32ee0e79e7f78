// SPDX-License-Identifier: MIT
// Walks on two legs at a commanded velocity, kicks on command, and gets up after a fall. Joints, gyroscope and
// accelerometer are read if there are any.
//
// A gait of footsteps and a pendulum (gait.hpp) or a kick (kick.hpp) gives the places of soles and centre of mass. The
// body (body.hpp) gives the angles for them, and how much springs of servos give way. Balance (balance.hpp) corrects
// ankles, hips and the places of feet by the sensors. All numbers of the robot are tunables (settings.hpp).
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "../common/angle.hpp"
#include "attitude.hpp"
#include "balance.hpp"
#include "body.hpp"
#include "gait.hpp"
#include "get_up.hpp"
#include "joints.hpp"
#include "kick.hpp"
#include "muro_controller.hpp"
#include "settings.hpp"
#include "springs.hpp"

namespace {

using namespace muro::controller;
using namespace walking;

enum Input { positions, angular_velocity, linear_acceleration, command, kick_command };
enum Output { targets, phase, odometry };

/// Mode of the robot, as in `walk.phase`.
enum Mode : std::int64_t { preparing, standing, walking_on, falling, getting_up, kicking };

class Walk {
 public:
  static constexpr const char* name = "walk";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary =
      "Walks on two legs by a pendulum, its capture point and gyro feedback; kicks; gets up";
  static constexpr muro_port inputs[] = {{"joint.position", "rad", 0, MURO_PORT_OPTIONAL},
                                         {"angular_velocity", "rad/s", 3, MURO_PORT_OPTIONAL},
                                         {"linear_acceleration", "m/s^2", 3, MURO_PORT_OPTIONAL},
                                         {"walk.command", "m/s, m/s, rad/s", 3, MURO_PORT_OPTIONAL},
                                         {"walk.kick", "1, m/s", 2, MURO_PORT_OPTIONAL}};
  static constexpr muro_port outputs[] = {{"joint.position.target", "rad", 0, 0},
                                          {"walk.phase", "1", 1, MURO_PORT_OWN},
                                          {"walk.odometry", "m, m, rad", 3, MURO_PORT_OWN}};
  static constexpr auto& tunables = tunable_table;

  explicit Walk(const Setup& setup)
      : joints_(setup.output_size(targets), setup.argument("directions"), setup.argument("zeros")),
        s_(setup.raw().tunables, setup.period()),
        body_(s_.body),
        get_up_(s_) {
    if (const auto n = setup.input_size(positions); n != 0 && n < Joints::legs_end)
      throw std::invalid_argument("joint.position needs the joints of both legs, as joint.position.target has them");
    state_.gait.stand({}, s_.gait);
    expect_reach();
  }

  void step(const Step& now) {
    const double h = now.period();
    if (now.index() == 0) change(preparing, now);
    state_.time += h;
    has_joints_ = !now.input(positions).empty();
    has_imu_ = now.input(angular_velocity).size() == 3 && now.input(linear_acceleration).size() == 3;
    if (has_joints_) {
      state_.measured = joints_.legs(now.input(positions));
      feel_springs(now, h);
    }
    if (has_imu_) feel(now, h);
    hear_kick(now);
    write(state_.mode == falling || state_.mode == getting_up ? get_up(now, h) : walk(now, h), now);
    if (state_.mode == getting_up && get_up_.is_done(state_.get_up)) stand_again(now);
    if (state_.mode == preparing && is_ready()) state_.calibrated = 1, change(standing, now);
    if (state_.mode == standing || state_.mode == walking_on)
      state_.mode = state_.gait.phase() == Gait::standing ? standing : walking_on;
    now.output(phase)[0] = double(state_.mode);
    const auto o = now.output(odometry);
    o[0] = state_.gait.along_x().position, o[1] = state_.gait.along_y().position, o[2] = state_.gait.yaw();
  }

  static constexpr double fallen = 0.6;    // least component of the trunk's z axis along "up"
  static constexpr double lie_down = 1.0;  // s, after which a falling robot lies
  static constexpr double settle = 0.6;    // s, after which a robot in its posture is at rest

 private:
  /// State that one step leaves for the next.
  struct State {
    double time = 0;  // s, since the beginning of the mode
    Mode mode = preparing;
    std::int64_t calibrated = 0;
    double heading = 0;  // rad, as commanded
    Gait gait;
    Attitude attitude;
    Balance balance;
    Kick kick;
    double kick_speed = 0;  // m/s, of the requested kick
    Side kick_side = left_side;
    std::int64_t kick_foot = 0;  // last foot in `walk.kick`
    GetUp::Progress get_up;
    BothLegs measured{}, plan{}, sag{};
    Springs springs;
    std::array<double, Joints::most> from{};  // targets when the mode began
  };

 public:
  static constexpr std::size_t save_size = sizeof(State);
  static_assert(std::is_trivially_copyable_v<State>);

  void save(Saver& to) const { to.put(state_); }
  void load(Loader& from) { state_ = from.get<State>(); }

 private:
  /// Throws when a leg is straight already in the stand: such a leg cannot step.
  void expect_reach() const {
    const Leg& leg = body_.leg(left_side);
    const Frame trunk = body_.trunk_for(reference(), s_.trunk_height, s_.lean);
    const Frame sole{{}, {0, 0.5 * s_.gait.foot_distance, 0}};
    const Frame asked = trunk.inverse() * sole;
    if ((leg.sole_at(leg.angles_for(asked)).origin - asked.origin).norm() > 1e-9)
      throw std::invalid_argument("trunk_height=" + std::to_string(s_.trunk_height) + " m is more than legs of " +
                                  std::to_string(leg.length()) +
                                  " m reach: lower it, or see to thigh, shin, hip_z and sole_z");
  }

  void change(Mode mode, const Step& now) {
    state_.mode = mode;
    state_.time = 0;
    std::ranges::copy(now.output(targets).first(joints_.size()), state_.from.begin());
  }

  bool is_ready() const {
    if (state_.calibrated) return state_.time > s_.prepare;
    return state_.time > s_.prepare + (has_imu_ ? settle + s_.calibrate : has_joints_ ? settle : 0);
  }

  /// Returns whether it has come to its posture for the first time, and waits for measurements there.
  bool is_at_rest() const { return state_.mode == preparing && !state_.calibrated && state_.time > s_.prepare; }

  void feel_springs(const Step& now, double h) {
    const BothLegs target = joints_.legs(now.output(targets));
    BothLegs behind;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t j = 0; j < leg_joints; ++j) behind[side][j] = target[side][j] - state_.measured[side][j];
    if (is_at_rest()) state_.springs.feel_at_rest(state_.sag, behind, h);
    if (state_.mode == standing || state_.mode == walking_on || state_.mode == kicking)
      state_.springs.feel(state_.sag, behind, reference(), h);
  }

  Posture walk(const Step& now, double h) {
    const bool may_walk = state_.mode == standing || state_.mode == walking_on;
    Velocity wanted = may_walk ? command_of(now) : Velocity{};
    if (has_imu_) wanted = hold_heading(wanted, h);
    if (has_imu_ && has_joints_) step_after_capture_point(h);
    state_.gait.advance(h, wanted, s_.gait);
    if (state_.mode == kicking) kick(now, h);
    const Posture posture{.legs = legs(has_imu_ && state_.mode != preparing), .arm = s_.arm};
    if (!has_imu_ || state_.attitude.up().z >= fallen) return posture;
    change(falling, now);
    return get_up_.straight();
  }

  /// Begins a kick when its foot changes from 0.
  void hear_kick(const Step& now) {
    const auto k = now.input(kick_command);
    if (k.size() != 2) return;
    const std::int64_t foot = (k[0] > 0.5) - (k[0] < -0.5), before = std::exchange(state_.kick_foot, foot);
    if (foot == 0 || before != 0 || (state_.mode != standing && state_.mode != walking_on)) return;
    state_.kick_side = foot > 0 ? left_side : right_side;
    state_.kick_speed = k[1];
    state_.kick.clear();
    change(kicking, now);
  }

  /// Kicks when the walk has ended with feet side by side.
  void kick(const Step& now, double h) {
    if (state_.gait.phase() != Gait::standing) return;
    if (!state_.kick.has_begun())
      state_.kick.begin(state_.gait.reference(s_.gait), state_.kick_side, state_.kick_speed, s_.kick);
    state_.kick.advance(h);
    if (!state_.kick.is_done(s_.kick)) return;
    state_.kick.clear();
    change(standing, now);
  }

  /// Returns the reference of the kick once it has begun, otherwise the one of the gait.
  Reference reference() const {
    return state_.kick.has_begun() ? state_.kick.reference(s_.kick) : state_.gait.reference(s_.gait);
  }

  Posture get_up(const Step& now, double h) {
    if (state_.mode == falling && state_.time <= lie_down) return get_up_.straight();
    if (state_.mode == falling) {
      state_.get_up.begin(state_.attitude.up().x > 0);
      change(getting_up, now);
    }
    get_up_.advance(state_.get_up, h);
    return get_up_.posture(state_.get_up);
  }

  void feel(const Step& now, double h) {
    const auto w = now.input(angular_velocity), f = now.input(linear_acceleration);
    const Vector rate{w[0], w[1], w[2]}, force{f[0], f[1], f[2]};
    // a robot that lies feels only gravity
    state_.attitude.update(rate, force, state_.mode == falling ? 10 * s_.attitude : s_.attitude, h);
    if (s_.calibrate <= 0 || !is_at_rest() || state_.time <= s_.prepare + settle) return;
    if (state_.attitude.up().z < 0.9) return;
    const BothLegs& angles = now.input(positions).empty() ? state_.plan : state_.measured;
    state_.attitude.calibrate(rate, force, body_.leg(left_side).sole_at(angles[left_side]).rotation.z);
  }

  Velocity command_of(const Step& now) const {
    const auto c = now.input(command);
    return c.size() == 3 ? Velocity{c[0], c[1], c[2]} : s_.command;
  }

  Velocity hold_heading(Velocity wanted, double h) {
    if (wanted.is_zero()) {
      state_.heading = state_.attitude.yaw();
      return wanted;
    }
    state_.heading += h * wanted.turn;
    const double off = examples::wrapped(state_.heading - state_.attitude.yaw());
    wanted.turn += std::clamp(s_.heading * off, -0.3, 0.3);
    return wanted;
  }

  void step_after_capture_point(double h) {
    const std::array<Frame, 2> soles{body_.leg(left_side).sole_at(state_.measured[left_side]),
                                     body_.leg(right_side).sole_at(state_.measured[right_side])};
    const double ahead = state_.balance.astray(reference(), s_.gait.w(), body_, state_.attitude, soles, s_.balance, h);
    state_.gait.find_astray(state_.springs.share() * s_.balance.capture * ahead, s_.gait);
  }

  BothLegs legs(bool feels) {
    const Reference now = reference();
    const Frame trunk = body_.trunk_for(now, s_.trunk_height, s_.lean);
    const BothLegs plan = body_.legs_for(now, trunk);
    state_.sag = body_.sag(now, trunk, plan);
    BothLegs q = plan;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t j = 0; j < leg_joints; ++j) q[side][j] += state_.springs.share() * state_.sag[side][j];
    state_.plan = plan;
    if (feels) keep_balance(q, now, state_.attitude, s_.lean, s_.balance, state_.springs.share());
    return q;
  }

  /// Moves to the posture of a mode within `prepare` s after its beginning.
  void write(const Posture& posture, const Step& now) {
    const auto out = now.output(targets);
    joints_.write(posture, out);
    if (state_.mode == standing || state_.mode == walking_on || state_.mode == kicking) return;
    const double part = std::min(1.0, state_.time / s_.prepare);
    const double done = part * part * (3 - 2 * part);
    for (std::size_t i = 0; i < joints_.size(); ++i) out[i] = state_.from[i] + done * (out[i] - state_.from[i]);
  }

  void stand_again(const Step& now) {
    change(preparing, now);
    state_.gait.stand({state_.gait.along_x().position, state_.gait.along_y().position, state_.gait.yaw()}, s_.gait);
    state_.balance.clear();
    state_.kick.clear();
    state_.springs.forget();
    state_.heading = state_.attitude.yaw();
  }

  Joints joints_;
  Settings s_;
  Body body_;
  GetUp get_up_;
  bool has_joints_ = false, has_imu_ = false;  // whether there are readings, in each step
  State state_;
};

}  // namespace

MURO_CONTROLLER(Walk)
