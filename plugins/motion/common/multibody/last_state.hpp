// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "robot_state.hpp"

namespace muro::multibody {

/// The state of a robot at the end of the last step, kept in a state block. A robot that has another state when the
/// next step begins was moved from outside.
class LastState {
 public:
  /// Number of values that it stores.
  static constexpr std::size_t size_for(std::size_t bodies) { return joints_at + 2 * bodies; }

  LastState() = default;
  explicit LastState(std::span<double> numbers) : numbers_(numbers) {}

  bool is_valid() const { return numbers_[valid_at] != 0; }
  void invalidate() { numbers_[valid_at] = 0; }

  bool matches(const RobotState& s) const {
    bool same = is_valid();
    const double *pose = numbers_.data() + pose_at, *twist = numbers_.data() + twist_at;
    for (int k = 0; k < 3; ++k)
      same =
          same && s.pose.position[k] == pose[k] && s.twist.linear[k] == twist[k] && s.twist.angular[k] == twist[3 + k];
    for (int k = 0; k < 4; ++k) same = same && s.pose.orientation.coeffs()[k] == pose[3 + k];
    const double* joints = numbers_.data() + joints_at;
    for (std::size_t i = 1; i < s.joints.size(); ++i)
      same = same && s.joints[i].position == joints[2 * i] && s.joints[i].velocity == joints[2 * i + 1];
    return same;
  }

  void store(const RobotState& s) {
    numbers_[valid_at] = 1;
    std::copy_n(s.pose.position.data(), 3, numbers_.data() + pose_at);
    std::copy_n(s.pose.orientation.coeffs().data(), 4, numbers_.data() + pose_at + 3);
    std::copy_n(s.twist.linear.data(), 3, numbers_.data() + twist_at);
    std::copy_n(s.twist.angular.data(), 3, numbers_.data() + twist_at + 3);
    for (std::size_t i = 1; i < s.joints.size(); ++i) {
      numbers_[joints_at + 2 * i] = s.joints[i].position;
      numbers_[joints_at + 2 * i + 1] = s.joints[i].velocity;
    }
  }

 private:
  // Layout: whether the rest is valid, pose, twist, then position and velocity of each body's joint.
  static constexpr std::size_t valid_at = 0, pose_at = 1, twist_at = 8, joints_at = 14;

  std::span<double> numbers_;
};

}  // namespace muro::multibody
