// SPDX-License-Identifier: MIT
// The properties of joints, their drives, and the data for kernels of the joints that no force drives.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "move.hpp"
#include "muro/simd/numbers.hpp"
#include "muro/toolkit/joint_drives.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "plugins/motion/common/position_drive/joint_target.hpp"

namespace muro::simplified {

/// The properties of a link's joint; null when there is no joint.
struct JointProperties {
  double* position = nullptr;
  double* velocity = nullptr;
  const double* target = nullptr;  ///< target of the mode; null: passive, or a mimic joint
  DriveMode mode = DriveMode::velocity;
  bool force_driven = false;   ///< moved by ForceDrivenJoints; kernels move the others
  bool feels_contact = false;  ///< a force-driven joint that wrenches on links move, too
  bool has_position_drive = false;
};

/// Returns the mode of a joint that kernels move.
constexpr Mode kernel_mode(DriveMode mode) {
  return mode == DriveMode::position       ? Mode::position
         : mode == DriveMode::acceleration ? Mode::acceleration
                                           : Mode::velocity;
}

/// Connects the properties of all joints, one per link. `start`: positions (rad or m). `modes`: mode of every joint.
/// `limited`: whether forces drive all joints whose effort the model limits, whatever their targets.
/// `has_position_drive`: for each link, whether its joint has a PD drive in mode position. Throws Error for a joint
/// that starts outside its limits. [setup]
inline std::vector<JointProperties> connect_joint_properties(Connector& c, const RobotView& robot,
                                                             const std::vector<double>& start,
                                                             const std::vector<DriveMode>& modes, bool limited,
                                                             const std::vector<bool>& has_position_drive) {
  std::vector<JointProperties> properties(robot.links.size());
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const Link& link = robot.links[i];
    if (link.joint == JointKind::fixed) continue;
    if (link.mimic < 0) check_start(c, link.joint_object, link.limits, start[i]);
    JointProperties& p = properties[i];
    const std::size_t leader = link.mimic >= 0 ? std::size_t(link.mimic) : i;
    p.mode = modes[leader];
    p.feels_contact = p.mode == DriveMode::effort || p.mode == DriveMode::passive ||
                      (limited && std::isfinite(robot.links[leader].limits.effort));
    p.has_position_drive = p.mode == DriveMode::position && has_position_drive[leader];
    p.force_driven = p.feels_contact || p.has_position_drive;
    p.position = c.variable(link.joint_object, keys::joint_position, start[i]).get();
    p.velocity = c.variable(link.joint_object, keys::joint_velocity, 0.0).get();
    if (link.mimic < 0) p.target = connect_joint_target(c, link.joint_object, p.mode, start[i]).get();
  }
  return properties;
}

/// Returns the joints of one mode in the form for kernels; sets the addresses of the first one in `state`.
inline std::vector<Joint> kernel_joints(const RobotView& robot, const std::vector<JointProperties>& properties,
                                        Mode mode, double acceleration, RobotState& state) {
  using lane::numbers_between;
  std::vector<Joint> joints;
  std::vector<int> number(properties.size(), -1);
  const auto is_one = [&](const JointProperties& p) {
    return p.position && !p.force_driven && kernel_mode(p.mode) == mode;
  };
  for (std::size_t i = 0, count = 0; i < properties.size(); ++i)
    if (is_one(properties[i])) number[i] = int(count++);
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const Link& link = robot.links[i];
    const JointProperties& p = properties[i];
    if (!is_one(p)) continue;
    if (!state.positions) state.positions = p.position, state.velocities = p.velocity;
    if (!state.targets) state.targets = p.target;
    Joint j;
    j.range = {link.limits.lower, link.limits.upper, link.limits.velocity, acceleration};
    j.position = numbers_between(state.positions, p.position);
    j.velocity = numbers_between(state.velocities, p.velocity);
    if (p.target) j.target = numbers_between(state.targets, p.target);
    if (link.mimic >= 0) {
      j.leader = number[std::size_t(link.mimic)];
      j.multiplier = link.mimic_multiplier;
      j.offset = link.mimic_offset;
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
