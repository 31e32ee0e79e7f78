// SPDX-License-Identifier: MIT
#include "joints.hpp"

#include <charconv>
#include <stdexcept>
#include <string>

namespace walking {

Joints::Joints(std::size_t count, std::string_view directions, std::string_view zeros) : count_(count) {
  if (count < legs_end || count > most)
    throw std::invalid_argument("joint.position.target has " + std::to_string(count) +
                                " joints; it needs those of both legs, 12, and takes 32 at most");
  direction_.fill(1), zero_.fill(0);
  if (directions.size() > count || directions.find_first_not_of("+-") != directions.npos)
    throw std::invalid_argument("directions=" + std::string(directions) + " is not one + or - for each of " +
                                std::to_string(count) + " joints");
  for (std::size_t i = 0; i < directions.size(); ++i) direction_[i] = directions[i] == '-' ? -1 : 1;
  const char* at = zeros.data();
  const char* const end = at + zeros.size();
  for (std::size_t i = 0; at != end; ++i) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || i >= count || (next != end && *next != ','))
      throw std::invalid_argument("zeros=" + std::string(zeros) +
                                  " is no list of numbers with commas, one for each of " + std::to_string(count) +
                                  " joints at most");
    zero_[i] = value;
    at = next == end ? end : next + 1;
  }
}

void Joints::write(const Posture& p, std::span<double> to) const {
  const ArmAngles& a = p.arm;
  const std::array<double, 6> arms{a[0], a[1], a[2], a[0], -a[1], -a[2]};
  for (std::size_t i = 0; i < count_; ++i) {
    double angle = 0;
    if (i < legs_end)
      angle = p.legs[i / leg_joints][i % leg_joints];
    else if (i < arms_end && count_ >= arms_end)
      angle = arms[i - legs_end];
    to[i] = direction_[i] * angle + zero_[i];
  }
}

BothLegs Joints::legs(std::span<const double> from) const {
  BothLegs angles;
  for (std::size_t i = 0; i < legs_end; ++i)
    angles[i / leg_joints][i % leg_joints] = direction_[i] * (from[i] - zero_[i]);
  return angles;
}

}  // namespace walking
