// SPDX-License-Identifier: MIT
// A robot by its numbers. They are all that `trot` knows of it.
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>

#include "balance.hpp"
#include "gait.hpp"
#include "joint_map.hpp"
#include "leg.hpp"
#include "muro_controller.hpp"
#include "muro_elementary.h"
#include "placement.hpp"
#include "tunables.hpp"

namespace quadruped {

/// A robot and its walk.
struct Model {
  std::array<Leg, legs> leg;
  JointMap joints;
  Gait gait;
  Placement placement;
  ForceDistribution distribution;
  BodyGains gains;
  Vector center, inertia, effort;  ///< m, without the legs; kg m^2; N m, of abduction, hip and knee
  LegMasses leg_masses;
  Vector stiffness, damping;  ///< N m/rad, N m s/rad: of the joints of a swinging leg
  double mass, gravity, height, foot_radius, wider, lift, press, speed;
  double acceleration, turn_acceleration, climb, reach_speed, trust, settling, leaning;

  /// Moments of inertia / mass / squared distances between hips, used when no moments are given. Values of robots like
  /// Unitree A1 and Mini Cheetah, whose trunks carry half the mass.
  static constexpr double by_width = 0.17, by_length = 0.2;

  explicit Model(const muro::controller::Setup& s);
  /// Returns the place of the middle of a foot below its hip, seen from the body: m.
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
  distribution.length = 0.5 * muro_hypot(is(t::hip_front) - is(t::hip_rear), 2 * is(t::hip_side));
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
  speed = is(t::speed), acceleration = is(t::acceleration), turn_acceleration = is(t::turn_acceleration);
  climb = is(t::climb), reach_speed = is(t::reach_speed), trust = is(t::trust), settling = is(t::settling),
  leaning = is(t::leaning);
  wider = is(t::wider);
  const auto part_of = [&](t::Index i, double fraction) { return is(i) > 0 ? is(i) : fraction * mass; };
  leg_masses = {part_of(t::thigh_mass, 0.046), part_of(t::shank_mass, 0.0125), part_of(t::foot_mass, 0.0042)};
  const double frequency = is(t::swing_frequency), ratio = is(t::swing_damping), drive = is(t::armature);
  const Vector moved = leg[0].inertia(leg_masses) + Vector{drive, drive, drive};
  stiffness = frequency * frequency * moved;
  damping = 2 * ratio * frequency * moved;
  if (height - foot_radius + is(t::hip_up) > 0.98 * length)
    throw std::invalid_argument("its legs are too short for the tunable `height`: lower it, or name `thigh`, `shank`");
}

}  // namespace quadruped
