// SPDX-License-Identifier: MIT
// Joints that no force moves: they follow their targets within the limits of the model.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "muro/toolkit/mass_properties.hpp"
#include "plugins/motion/common/position_drive/joint_target.hpp"
#include "plugins/motion/common/position_drive/target_interpolation.hpp"

namespace muro {

/// All joints of one robot. The velocity of a joint is constant within a step, and `joint.velocity` is that velocity.
/// So a ramp at the speed limit is exact for any step size. A joint without a target stands still. Mimic joints follow
/// their leaders and ignore their own limits.
class KinematicJoints {
 public:
  KinematicJoints() = default;
  /// `modes`: mode of every link's joint. Joints in mode effort or passive stand still. When `modes` is empty, each
  /// joint follows `joint.position.target` if something writes it, else `joint.velocity.target`; then call
  /// follow_what_is_written(). `left_out`: links whose joints, and the joints that mimic them, are not moved here;
  /// empty: none. Throws Error for a joint that starts outside its limits. [setup]
  KinematicJoints(Connector& c, const RobotView& robot, std::span<const DriveMode> modes,
                  const std::vector<bool>& left_out = {}) {
    const auto is_one = [&](const Link& link, std::size_t i) {
      const std::size_t own = link.mimic < 0 ? i : std::size_t(link.mimic);
      return link.joint != JointKind::fixed && (left_out.empty() || !left_out[own]);
    };
    const std::vector<double> start = initial_joint_positions(c, robot);
    std::vector<Mimic> all(robot.links.size());
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      if (!is_one(link, i)) continue;
      all[i].position = c.variable(link.joint_object, keys::joint_position, start[i]);
      all[i].velocity = c.variable(link.joint_object, keys::joint_velocity, 0.0);
      if (link.mimic >= 0) continue;
      check_start(c, link.joint_object, link.limits, start[i]);
      Joint j;
      j.position = all[i].position, j.velocity = all[i].velocity;
      j.lower = link.limits.lower, j.upper = link.limits.upper, j.speed = link.limits.velocity;
      j.object = link.joint_object;
      const bool any = modes.empty();
      j.target = connect_joint_target(c, j.object, any ? DriveMode::velocity : modes[i], start[i]);
      if (any) j.position_target = connect_joint_target(c, j.object, DriveMode::position, start[i]);
      j.mode = any ? DriveMode::velocity : modes[i];
      if (j.mode != DriveMode::velocity && j.mode != DriveMode::position) {
        stands_still_ = true;
        continue;
      }
      joints_.push_back(j);
      names_.emplace_back(c.object_name(j.object));
    }
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      if (link.mimic < 0 || !is_one(link, i)) continue;
      Mimic& m = mimics_.emplace_back(all[i]);
      m.leader_position = all[std::size_t(link.mimic)].position;
      m.leader_velocity = all[std::size_t(link.mimic)].velocity;
      m.multiplier = link.mimic_multiplier;
      m.offset = link.mimic_offset;
    }
  }

  /// Chooses the targets of joints without given modes. Call it when all algorithms have connected. [setup]
  void follow_what_is_written(const Connector& c) {
    for (Joint& j : joints_) {
      if (!j.position_target || !is_written(c, j.object, keys::joint_position_target)) continue;
      j.mode = DriveMode::position;
      j.target = j.position_target;
    }
  }

  /// Moves position targets evenly to each new value within `period` (s); 0: at once. `base`: object that keeps the
  /// memory of this. [setup]
  void interpolate(Connector& c, ObjectId base, double period) {
    if (period <= 0 || joints_.empty()) return;
    constexpr std::size_t one = TargetInterpolation::numbers;
    auto* memory = static_cast<double*>(
        c.state_block(base, "kinematic_joints.interpolation", std::uint32_t(joints_.size() * one * sizeof(double))));
    period_ = period;
    for (std::size_t i = 0; i < joints_.size(); ++i)
      joints_[i].interpolation = TargetInterpolation(std::span(memory + i * one, one));
  }
  /// Takes the joints over from another motion that has moved them so far. [between steps]
  void take_over() const {
    for (const Joint& j : joints_) j.interpolation.invalidate();
  }

  /// Whether some joint is in a mode in which only forces move it.
  bool stands_still() const { return stands_still_; }

  /// Moves all joints forward by `dt` (s). Throws Error with the name of a joint whose target is not finite. [step]
  void move(double dt) const {
    for (const Joint& j : joints_)
      if (!j.move(dt, period_))
        throw Error("the target of `" + names_[std::size_t(&j - joints_.data())] +
                    "` is not finite; look at what writes its `joint.*.target`");
    for (const Mimic& m : mimics_) {
      *m.position = m.offset + m.multiplier * *m.leader_position;
      *m.velocity = m.multiplier * *m.leader_velocity;
    }
  }

 private:
  struct Joint {
    Out<double> position, velocity;
    In<double> target, position_target;
    double lower = 0, upper = 0, speed = 0;
    ObjectId object = no_object;
    DriveMode mode = DriveMode::velocity;
    TargetInterpolation interpolation;

    /// Moves the joint. Returns whether the target is finite. A joint that was put beyond its limits may come back but
    /// not go further.
    bool move(double dt, double period) const {
      const double from = *position, low = std::min(lower, from), high = std::max(upper, from);
      double to = 0, v = 0;
      if (mode == DriveMode::position) {
        const double wanted = period > 0 ? interpolation.advance(*target, from, period, dt).position : *target;
        to = std::clamp(wanted, lower, upper);
        v = (to - from) / dt;
        if (std::abs(v) > speed) {
          v = std::copysign(speed, v);
          to = from + v * dt;
        }
      } else {
        v = std::clamp(*target, -speed, speed);
        const double free = from + v * dt;
        to = std::clamp(free, low, high);
        if (to != free) v = (to - from) / dt;
      }
      if (!std::isfinite(to)) return false;
      *position = to;
      *velocity = v;
      return true;
    }
  };
  struct Mimic {
    Out<double> position, velocity, leader_position, leader_velocity;
    double multiplier = 1, offset = 0;
  };

  static bool is_written(const Connector& c, ObjectId joint, const KeyInfo& key) {
    return c.is_used(joint, key, usage::write) || c.is_used(joint, key, usage::optional_output) ||
           c.is_used(joint, key, usage::variable) || c.is_used(joint, key, usage::derived);
  }

  std::vector<Joint> joints_;
  std::vector<std::string> names_;  ///< names of the joints
  std::vector<Mimic> mimics_;
  double period_ = 0;  ///< s, see interpolate()
  bool stands_still_ = false;
};

}  // namespace muro
