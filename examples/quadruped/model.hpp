// SPDX-License-Identifier: MIT
// The numbers of a robot: all that `trot` knows of it comes from here.
#pragma once

#include <array>
#include <charconv>
#include <stdexcept>
#include <string>

#include "balance.hpp"
#include "gait.hpp"
#include "leg.hpp"
#include "muro_controller.hpp"
#include "placement.hpp"

namespace quadruped {

inline constexpr int joints_of_leg = 3, joints = legs * joints_of_leg;

namespace tunable {

enum Index : std::size_t {
  forward,
  left,
  turn,
  step_in_place,
  hip_front,
  hip_rear,
  hip_side,
  hip_up,
  abduction,
  thigh,
  shank,
  foot_radius,
  bend_front,
  bend_rear,
  mass,
  center_x,
  center_z,
  inertia_x,
  inertia_y,
  inertia_z,
  gravity,
  friction,
  effort_abduction,
  effort_hip,
  effort_knee,
  rate_most,
  height,
  period,
  duty,
  lift,
  press,
  placement_gain,
  step_most,
  wider,
  acceleration,
  turn_acceleration,
  climb,
  gain_speed,
  gain_trim,
  gain_height,
  gain_climb,
  gain_attitude,
  gain_rotation,
  gain_heading,
  gain_turn,
  gain_place,
  gain_swing,
  gain_swing_rate,
  reach_speed,
  trust,
  settling,
};

inline constexpr muro_tunable all[] = {
    {"forward", "m/s", 0, -3, 3, "command where no command.twist is connected"},
    {"left", "m/s", 0, -2, 2, "the same, to the side"},
    {"turn", "rad/s", 0, -3, 3, "the same, counter-clockwise"},
    {"step_in_place", "1", 0, 0, 1, "1: it trots without a command, too"},
    {"hip_front", "m", 0.18, -2, 2, "axes of abduction of the front legs, along x of the body"},
    {"hip_rear", "m", -0.18, -2, 2, "of the rear legs"},
    {"hip_side", "m", 0.07, 0, 2, "of the left legs, along y"},
    {"hip_up", "m", 0, -1, 1, "of all legs, along z"},
    {"abduction", "m", 0.06, 0, 1, "from the axis of abduction outwards to the plane of thigh and shank"},
    {"thigh", "m", 0.2, 0.01, 2, "length"},
    {"shank", "m", 0.2, 0.01, 2, "length, to the middle of the foot"},
    {"foot_radius", "m", 0.02, 0, 0.5, "of the ball"},
    {"bend_front", "1", -1, -1, 1, "sign of the angle of the front knees; below 0 they point backwards"},
    {"bend_rear", "1", -1, -1, 1, "the same of the rear knees"},
    {"mass", "kg", 12, 0.05, 1000, "of the robot"},
    {"center_x", "m", 0, -1, 1, "centre of mass of the standing robot in the frame of the body"},
    {"center_z", "m", -0.035, -1, 1, "the same, along z"},
    {"inertia_x", "kg m^2", 0, 0, 1000, "of the standing robot about its centre of mass; 0: by mass and hips"},
    {"inertia_y", "kg m^2", 0, 0, 1000, "the same about y"},
    {"inertia_z", "kg m^2", 0, 0, 1000, "the same about z"},
    {"gravity", "m/s^2", 9.81, 0.1, 100, "where it walks"},
    {"friction", "1", 0.6, 0.05, 2, "of the feet on the ground, that it counts on"},
    {"effort_abduction", "N m", 20, 0.01, 1e4, "limit of the joints"},
    {"effort_hip", "N m", 20, 0.01, 1e4, "the same"},
    {"effort_knee", "N m", 20, 0.01, 1e4, "the same"},
    {"rate_most", "rad/s", 12, 0.1, 100, "limit of the joints' speed, of swinging legs"},
    {"height", "m", 0, 0, 3, "of the origin of the body above the ground; 0: hips at 0.75 of a straight leg"},
    {"period", "s", 0.4, 0.1, 2, "of a stride"},
    {"duty", "1", 0.5, 0.5, 0.9, "part of the stride in which a foot stands"},
    {"lift", "m", 0.06, 0.005, 0.5, "of a swinging foot above the ground"},
    {"press", "m", 0.005, 0, 0.1, "below the ground, where a swinging foot is sent to"},
    {"placement_gain", "s", 0.06, 0, 0.5, "Raibert's: a foot goes farther out by what the body is too fast"},
    {"step_most", "m", 0, 0, 1, "of a foot from the place below its hip; 0: 0.45 of a straight leg"},
    {"wider", "m", 0, -0.2, 0.3, "by which feet stand farther out than their hips"},
    {"acceleration", "m/s^2", 1, 0.05, 20, "by which it follows commands"},
    {"turn_acceleration", "rad/s^2", 3, 0.05, 50, "the same"},
    {"climb", "m/s", 0.3, 0.01, 2, "of the body when it stands up"},
    {"gain_speed", "1/s", 8, 0, 50, "of the body along the ground"},
    {"gain_trim", "1/s", 1, 0, 20, "of what is missing of the speed for long"},
    {"gain_height", "1/s^2", 150, 0, 2000, "of the body's height"},
    {"gain_climb", "1/s", 20, 0, 200, "of its change"},
    {"gain_attitude", "1/s^2", 200, 0, 2000, "of roll and pitch"},
    {"gain_rotation", "1/s", 25, 0, 200, "of their rates"},
    {"gain_heading", "1/s^2", 40, 0, 2000, "of the yaw"},
    {"gain_turn", "1/s", 15, 0, 200, "of its rate"},
    {"gain_place", "1/s^2", 20, 0, 500, "of the place above the feet while it stands"},
    {"gain_swing", "1/s^2", 30, 0.1, 1000,
     "stiffness of the joints of a swinging leg by mass and squared length of leg"},
    {"gain_swing_rate", "1/s", 0.8, 0.001, 100, "their damping, likewise"},
    {"reach_speed", "m/s", 0.3, 0.01, 2, "of a foot that finds no ground where it should be"},
    {"trust", "1/s", 40, 0.1, 1000, "in the legs that stand rather than in the accelerometer"},
    {"settling", "1/s", 20, 0.1, 1000, "of the height of the ground"},
};

}  // namespace tunable

/// What is wrong with a number in the scenario.
inline std::invalid_argument complaint(std::string_view argument, std::string_view text, const std::string& allowed) {
  return std::invalid_argument("argument `" + std::string(argument) + "` is \"" + std::string(text) + "\"; it is " +
                               allowed);
}

/// Calls `take` for each word of a text.
template <class Take>
void for_words(std::string_view text, Take take) {
  for (std::size_t at = text.find_first_not_of(" ,"); at != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(" ,", at), text.size());
    take(text.substr(at, end - at));
    at = text.find_first_not_of(" ,", end);
  }
}

/// Between the joints of the robot, as they are connected, and the angles of `Leg`.
struct JointMap {
  std::array<int, legs> place{0, 1, 2, 3};  ///< where the joints of front left, front right, ... are connected
  std::array<double, joints> sign, offset;  ///< by place: angle = sign * position + offset, rad

  explicit JointMap(const muro::controller::Setup& setup) {
    sign.fill(1), offset.fill(0);
    const std::string_view order = setup.argument("legs", "FL FR RL RR");
    read_order(order);
    read_numbers("signs", setup.argument("signs"), sign);
    read_numbers("offsets", setup.argument("offsets"), offset);
    for (const double s : sign)
      if (std::abs(s) != 1) throw complaint("signs", setup.argument("signs"), "12 times 1 or -1");
  }
  std::size_t at(int leg, int joint) const { return std::size_t(place[std::size_t(leg)] * joints_of_leg + joint); }
  Vector angles(int leg, std::span<const double> positions) const {
    const auto a = [&](int j) { return sign[at(leg, j)] * positions[at(leg, j)] + offset[at(leg, j)]; };
    return {a(0), a(1), a(2)};
  }
  Vector rates(int leg, std::span<const double> velocities) const {
    const auto r = [&](int j) { return sign[at(leg, j)] * velocities[at(leg, j)]; };
    return {r(0), r(1), r(2)};
  }

 private:
  void read_order(std::string_view text) {
    constexpr std::string_view names[] = {"FL", "FR", "RL", "RR"};
    const std::string allowed = "FL, FR, RL and RR, each once, in the order in which their joints are connected";
    int seen = 0, count = 0;
    for_words(text, [&](std::string_view word) {
      const auto* const name = std::find(std::begin(names), std::end(names), word);
      if (name == std::end(names) || count >= legs) throw complaint("legs", text, allowed);
      place[std::size_t(name - names)] = count++;
      seen |= 1 << (name - names);
    });
    if (seen != 15) throw complaint("legs", text, allowed);
  }
  static void read_numbers(std::string_view argument, std::string_view text, std::array<double, joints>& to) {
    if (text.empty()) return;
    const std::string allowed = "12 numbers, in the order in which the joints are connected";
    std::size_t count = 0;
    for_words(text, [&](std::string_view word) {
      if (count == joints) throw complaint(argument, text, allowed);
      const auto read = std::from_chars(word.data(), word.data() + word.size(), to[count++]);
      if (read.ec != std::errc() || read.ptr != word.data() + word.size() || !std::isfinite(to[count - 1]))
        throw complaint(argument, text, allowed);
    });
    if (count != joints) throw complaint(argument, text, allowed);
  }
};

/// A robot and how it is to walk.
struct Model {
  std::array<Leg, legs> leg;
  JointMap joints;
  Gait gait;
  Placement placement;
  ForceDistribution distribution;
  BodyGains gains;
  Vector center, inertia, effort;  ///< m, kg m^2, N m of abduction, hip and knee
  double mass, gravity, height, foot_radius, lift, press, rate_most;
  double acceleration, turn_acceleration, climb;
  double swing_stiffness, swing_damping, reach_speed, trust, settling;
  double wider;

  /// Moments of inertia by the mass and the squared distances between hips, where none are given: of robots of the
  /// class of Unitree A1 and Mini Cheetah, whose trunks carry half the mass.
  static constexpr double by_width = 0.17, by_length = 0.2;

  explicit Model(const muro::controller::Setup& s);
  /// Where the middle of a foot is below its hip, seen from the body: m.
  Vector below_hip(int name) const {
    const Leg& l = leg[std::size_t(name)];
    const double out = l.abduction < 0 ? -wider : wider;
    return l.hip + Vector{0, l.abduction + out, 0};
  }
};

inline Model::Model(const muro::controller::Setup& s) : joints(s) {
  namespace t = tunable;
  const auto is = [&](t::Index i) { return s.tunable(i); };
  for (int name = 0; name < legs; ++name) {
    const bool front = name == front_left || name == front_right;
    const double side = name == front_left || name == rear_left ? 1 : -1;
    Leg& l = leg[std::size_t(name)];
    l.hip = {is(front ? t::hip_front : t::hip_rear), side * is(t::hip_side), is(t::hip_up)};
    l.abduction = side * is(t::abduction), l.thigh = is(t::thigh), l.shank = is(t::shank);
    l.bend = is(front ? t::bend_front : t::bend_rear) < 0 ? -1 : 1;
  }
  gait = {is(t::period), is(t::duty)};
  mass = is(t::mass), gravity = is(t::gravity), foot_radius = is(t::foot_radius);
  const double length = is(t::thigh) + is(t::shank);
  height = is(t::height) > 0 ? is(t::height) : 0.75 * length + foot_radius - is(t::hip_up);
  placement = {is(t::placement_gain), is(t::step_most) > 0 ? is(t::step_most) : 0.45 * length, height, gravity};
  distribution.friction = is(t::friction);
  distribution.length = 0.5 * std::hypot(is(t::hip_front) - is(t::hip_rear), 2 * is(t::hip_side));
  distribution.least = 0.02 * mass * gravity, distribution.most = 1.5 * mass * gravity;
  gains = {.speed = is(t::gain_speed),
           .trim = is(t::gain_trim),
           .height = is(t::gain_height),
           .climb = is(t::gain_climb),
           .attitude = is(t::gain_attitude),
           .rotation = is(t::gain_rotation),
           .heading = is(t::gain_heading),
           .turn = is(t::gain_turn),
           .place = is(t::gain_place)};
  center = {is(t::center_x), 0, is(t::center_z)};
  const double along = is(t::hip_front) - is(t::hip_rear), across = 2 * (is(t::hip_side) + is(t::abduction));
  const auto inertia_of = [&](t::Index i, double squares) { return is(i) > 0 ? is(i) : mass * squares; };
  inertia = {inertia_of(t::inertia_x, by_width * across * across), inertia_of(t::inertia_y, by_length * along * along),
             inertia_of(t::inertia_z, by_length * along * along + 0.5 * by_width * across * across)};
  effort = {is(t::effort_abduction), is(t::effort_hip), is(t::effort_knee)};
  lift = is(t::lift), press = is(t::press);
  rate_most = is(t::rate_most), acceleration = is(t::acceleration);
  turn_acceleration = is(t::turn_acceleration), climb = is(t::climb);
  swing_stiffness = is(t::gain_swing) * mass * length * length,
  swing_damping = is(t::gain_swing_rate) * mass * length * length;
  reach_speed = is(t::reach_speed), trust = is(t::trust), settling = is(t::settling);
  wider = is(t::wider);
  if (height - foot_radius + is(t::hip_up) > 0.98 * length)
    throw std::invalid_argument("its legs are too short for the tunable `height`: lower it, or name `thigh`, `shank`");
}

}  // namespace quadruped
