// SPDX-License-Identifier: MIT
// Relation of joints and wheels of a vehicle with steered wheels: which joint turns which wheel, and by how much.
#pragma once

#include <algorithm>
#include <vector>

#include "rolling_constraints.hpp"

namespace muro::wheels {

/// heading = zero_heading + gain * angle of the joint that steers the wheel
struct WheelSteering {
  std::int32_t joint = -1;  ///< index in SteeringGeometry::joints; -1: the wheel is not steered
  double gain = 0;
  double zero_heading = 0;  ///< rad, in the frame of the base
};

struct SteeringGeometry {
  /// Links whose joints steer, each once. A mimic joint is replaced by the joint that it follows.
  std::vector<std::size_t> joints;
  std::vector<WheelSteering> wheels;  ///< one a wheel
};

/// How `wheels` of a robot with these links are steered. [setup]
inline SteeringGeometry steering_geometry(Rows<Link> links, std::span<const SteeredWheel> wheels) {
  SteeringGeometry geometry;
  for (const SteeredWheel& wheel : wheels) {
    WheelSteering steering{.zero_heading = PlanarWheel(wheel).zero_heading};
    if (wheel.steering >= 0) {
      const Link& link = links[std::size_t(wheel.steering)];
      const bool is_mimic = link.mimic >= 0;
      const std::size_t leader = is_mimic ? std::size_t(link.mimic) : std::size_t(wheel.steering);
      steering.gain = wheel.steering_direction * (is_mimic ? link.mimic_multiplier : 1);
      steering.zero_heading += is_mimic ? wheel.steering_direction * link.mimic_offset : 0;
      const auto known = std::find(geometry.joints.begin(), geometry.joints.end(), leader);
      steering.joint = std::int32_t(known - geometry.joints.begin());
      if (known == geometry.joints.end()) geometry.joints.push_back(leader);
    }
    geometry.wheels.push_back(steering);
  }
  return geometry;
}

}  // namespace muro::wheels
