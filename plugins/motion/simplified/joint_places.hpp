// SPDX-License-Identifier: MIT
// Where joints lie in memory, what drives each, and what kernels are told of those that need no force.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "move.hpp"
#include "muro/simd/numbers.hpp"
#include "muro/toolkit/joint_drives.hpp"
#include "muro/toolkit/mass_properties.hpp"

namespace muro::simplified {

/// A joint; null where there is none.
struct Place {
  double* position = nullptr;
  double* velocity = nullptr;
  const double* target = nullptr;  ///< of the mode; null: passive, or a mimic
  DriveMode mode = DriveMode::velocity;
  bool forced = false;  ///< moved by forces, by ForcedJoints; the others are moved by kernels
};

/// Of the joints that kernels move.
constexpr Mode kernel_mode(DriveMode mode) {
  return mode == DriveMode::position       ? Mode::position
         : mode == DriveMode::acceleration ? Mode::acceleration
                                           : Mode::velocity;
}

inline In<double> connect_target(Connector& c, ObjectId joint, DriveMode mode, double position) {
  switch (mode) {
    case DriveMode::velocity:
      return c.input(joint, keys::joint_velocity_target, 0.0);
    case DriveMode::position:
      return c.input(joint, keys::joint_position_target, position);
    case DriveMode::acceleration:
      return c.input(joint, keys::joint_acceleration_target, 0.0);
    case DriveMode::effort:
      return c.input(joint, keys::joint_effort_target, 0.0);
    case DriveMode::passive:
      break;
  }
  return {};
}

/// One a frame. `start`: positions (rad or m). `limited`: forces move all joints whose effort the model limits, also
/// those with other targets. Throws Error for a joint that starts outside its limits. [setup]
inline std::vector<Place> connect_places(Connector& c, const RobotView& robot, const std::vector<double>& start,
                                         bool limited) {
  const std::vector<DriveMode> modes = drive_modes_of(c, robot, c.parameters());
  std::vector<Place> places(robot.links.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Link& f = robot.links[i];
    if (f.joint == JointKind::fixed) continue;
    check_start(c, f.joint_object, f.limits, start[i]);
    Place& p = places[i];
    const std::size_t leader = f.mimic >= 0 ? std::size_t(f.mimic) : i;
    p.mode = modes[leader];
    p.forced = p.mode == DriveMode::effort || p.mode == DriveMode::passive ||
               (limited && std::isfinite(robot.links[leader].limits.effort));
    p.position = c.variable(f.joint_object, keys::joint_position, start[i]).get();
    p.velocity = c.variable(f.joint_object, keys::joint_velocity, 0.0).get();
    if (f.mimic < 0) p.target = connect_target(c, f.joint_object, p.mode, start[i]).get();
  }
  return places;
}

/// The joints of one mode as kernels see them; sets the places of the first one in `state`.
inline std::vector<Joint> kernel_joints(const RobotView& robot, const std::vector<Place>& places, Mode mode,
                                        double acceleration, RobotState& state) {
  using lane::numbers_between;
  std::vector<Joint> joints;
  std::vector<int> number(places.size(), -1);
  const auto is_one = [&](const Place& p) { return p.position && !p.forced && kernel_mode(p.mode) == mode; };
  for (std::size_t i = 0, count = 0; i < places.size(); ++i)
    if (is_one(places[i])) number[i] = int(count++);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Link& f = robot.links[i];
    const Place& p = places[i];
    if (!is_one(p)) continue;
    if (!state.positions) state.positions = p.position, state.velocities = p.velocity;
    if (!state.targets) state.targets = p.target;
    Joint j;
    j.range = {f.limits.lower, f.limits.upper, f.limits.velocity, acceleration};
    j.position = numbers_between(state.positions, p.position);
    j.velocity = numbers_between(state.velocities, p.velocity);
    if (p.target) j.target = numbers_between(state.targets, p.target);
    if (f.mimic >= 0) {
      j.leader = number[std::size_t(f.mimic)];
      j.multiplier = f.mimic_multiplier;
      j.offset = f.mimic_offset;
    }
    joints.push_back(j);
  }
  for (std::size_t k = 0; k + 4 <= joints.size(); ++k) {
    joints[k].four = true;
    for (std::ptrdiff_t n = 0; n < 4; ++n) {
      const Joint &first = joints[k], &j = joints[k + std::size_t(n)];
      joints[k].four = first.four && j.leader < 0 && j.position == first.position + n &&
                       j.velocity == first.velocity + n && j.target == first.target + n;
    }
  }
  return joints;
}

}  // namespace muro::simplified
