// SPDX-License-Identifier: MIT
// Joints that are not wheels: they follow their velocity targets at once, or follow other joints.
#pragma once

#include <algorithm>

#include "muro/plugin.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/per_robot.hpp"

namespace muro::wheels {

/// Position and velocity of the joint of every link, if they are bound.
struct JointState {
  std::vector<Out<double>> position, velocity;
  explicit JointState(const RobotView& robot) : position(robot.links.size()), velocity(robot.links.size()) {}
  /// Binds `position` and `velocity` of `joint`, which leads to `link`.
  template <class Joint>
  void bind(std::size_t link, const Joint& joint) {
    position[link] = joint.position;
    velocity[link] = joint.velocity;
  }
};

class NonWheelJoints {
 public:
  /// Joints of one robot.
  struct OfRobot {
    Range joints, mimics;
  };

  /// Binds the joints of `robot` that `state` has not bound yet, and all that follow others. `positions`: at the start,
  /// one a link. [setup]
  OfRobot connect(Connector& c, const RobotView& robot, std::span<const double> positions, JointState& state) {
    std::vector<Joint> joints;
    std::vector<Mimic> mimics;
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      if (link.joint == JointKind::fixed || state.position[i]) continue;
      state.position[i] = c.variable(link.joint_object, keys::joint_position, positions[i]);
      state.velocity[i] = c.variable(link.joint_object, keys::joint_velocity, 0.0);
      if (link.mimic >= 0) continue;
      check_start(c, link.joint_object, link.limits, positions[i]);
      joints.push_back({c.input(link.joint_object, keys::joint_velocity_target, 0.0), state.position[i],
                        state.velocity[i], link.limits});
    }
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      if (link.mimic < 0) continue;
      const auto leader = std::size_t(link.mimic);
      mimics.push_back({state.position[leader], state.velocity[leader], state.position[i], state.velocity[i],
                        link.mimic_multiplier, link.mimic_offset});
    }
    return {joints_.add(joints), mimics_.add(mimics)};
  }

  /// Moves the joints of `robot` for `dt` (s). [step]
  void move(const OfRobot& robot, double dt) const {
    for (const Joint& joint : joints_[robot.joints]) joint.move(dt);
    for (const Mimic& mimic : mimics_[robot.mimics]) mimic.follow();
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
  struct Mimic {
    Out<double> leader_position, leader_velocity, position, velocity;
    double multiplier = 1, offset = 0;
    void follow() const {
      *position = offset + multiplier * *leader_position;
      *velocity = multiplier * *leader_velocity;
    }
  };
  PackedLists<Joint> joints_;
  PackedLists<Mimic> mimics_;
};

}  // namespace muro::wheels
