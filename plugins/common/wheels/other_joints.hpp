// SPDX-License-Identifier: MIT
// Joints that are no wheels: they follow their velocity targets at once, or other joints.
#pragma once

#include <algorithm>

#include "muro/plugin.hpp"
#include "muro/toolkit/mass_properties.hpp"

namespace muro::wheeled {

/// Position and velocity of the joint of every frame, as far as they are bound.
struct JointState {
  std::vector<Out<double>> position, velocity;
  explicit JointState(const RobotView& robot) : position(robot.links.size()), velocity(robot.links.size()) {}
};

class OtherJoints {
 public:
  /// Takes the joints of the next robot whose `state` is not bound yet, and all that follow others. `positions`: at the
  /// start, one a frame. [setup]
  void connect(Connector& c, const RobotView& robot, std::span<const double> positions, JointState& state) {
    Part part{{std::uint32_t(joints_.size()), 0}, {std::uint32_t(followers_.size()), 0}};
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& f = robot.links[i];
      if (f.joint == JointKind::fixed || state.position[i]) continue;
      state.position[i] = c.variable(f.joint_object, keys::joint_position, positions[i]);
      state.velocity[i] = c.variable(f.joint_object, keys::joint_velocity, 0.0);
      if (f.mimic >= 0) continue;
      check_start(c, f.joint_object, f.limits, positions[i]);
      joints_.push_back(
          {c.input(f.joint_object, keys::joint_velocity_target, 0.0), state.position[i], state.velocity[i], f.limits});
    }
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& f = robot.links[i];
      if (f.mimic < 0) continue;
      const auto leader = std::size_t(f.mimic);
      followers_.push_back({state.position[leader], state.velocity[leader], state.position[i], state.velocity[i],
                            f.mimic_multiplier, f.mimic_offset});
    }
    part.joints.end = std::uint32_t(joints_.size());
    part.followers.end = std::uint32_t(followers_.size());
    parts_.push_back(part);
  }

  /// Moves those of robot `i` (in the order of connecting) for `dt` (s). [step]
  void move(std::uint32_t i, double dt) const {
    const Part& part = parts_[i];
    for (std::uint32_t k = part.joints.begin; k < part.joints.end; ++k) joints_[k].move(dt);
    for (std::uint32_t k = part.followers.begin; k < part.followers.end; ++k) followers_[k].follow();
  }

 private:
  struct Joint {
    In<double> target;
    Out<double> position, velocity;
    JointLimits limits;
    void move(double dt) const {
      const double v = std::clamp(*target, -limits.velocity, limits.velocity);
      const double reached = *position + v * dt;
      *position = std::clamp(reached, limits.lower, limits.upper);
      *velocity = *position == reached ? v : 0;
    }
  };
  struct Follower {
    Out<double> leader_position, leader_velocity, position, velocity;
    double multiplier = 1, offset = 0;
    void follow() const {
      *position = offset + multiplier * *leader_position;
      *velocity = multiplier * *leader_velocity;
    }
  };
  struct Part {
    Range joints, followers;
  };
  std::vector<Joint> joints_;
  std::vector<Follower> followers_;
  std::vector<Part> parts_;  ///< one a robot
};

}  // namespace muro::wheeled
