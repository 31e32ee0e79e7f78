// SPDX-License-Identifier: MIT
// The joints of one robot: the sense in which each turns, its zero, and their order in ports.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "body.hpp"

namespace walking {

/// Shoulder pitch and roll, elbow of the left arm. Roll and elbow of the right arm turn the other way.
using ArmAngles = std::array<double, 3>;

struct Posture {
  BothLegs legs{};
  ArmAngles arm{};
};

/// Ports hold the left leg (hip yaw, roll, pitch, knee, ankle pitch, roll), the right leg, then the left and the right
/// arm (shoulder pitch, shoulder roll, elbow) if there are so many, and any other joints, which are kept at 0.
class Joints {
 public:
  static constexpr std::size_t legs_end = 2 * leg_joints, arms_end = legs_end + 6, most = 32;

  /// `directions`: one + or - for each joint, in the order of the port; - when it turns against REP-103. `zeros`:
  /// numbers with commas, rad, the joint's reading with the leg straight. Missing entries are + and 0. Throws
  /// std::invalid_argument.
  Joints(std::size_t count, std::string_view directions, std::string_view zeros);

  std::size_t size() const { return count_; }
  void write(const Posture& posture, std::span<double> to) const;
  BothLegs legs(std::span<const double> from) const;

 private:
  std::size_t count_;
  std::array<double, most> direction_, zero_;
};

}  // namespace walking
