// SPDX-License-Identifier: MIT
// Wheeled vehicles for tests.
#pragma once

#include "tests/support/bodies.hpp"

namespace muro::test {

/// A wheel with a joint "NAME_joint" and a body "NAME_wheel".
struct WheelPart {
  std::string name;
  Vec3 at = Vec3::Zero();  ///< m, of the joint in the frame of the base
  double radius = 0.05;    ///< m
  Vec3 axis = Vec3::UnitY();
  JointLimits limits{};
  Shape shape{};  ///< used when `own_shape`
  bool own_shape = false;
  bool visual = false;  ///< the shape is visible but does not collide
};

/// Returns a cylinder whose axis is the y axis.
Shape tyre(double radius, double length = 0.04);

/// Returns a base "chassis" with the wheels and with what `more` adds.
RobotTree wheeled_robot(
    const std::vector<WheelPart>& wheels, const std::function<void(RobotBuilder&)>& more = [](RobotBuilder&) {});

/// Returns a vehicle with two driven wheels on the y axis of the base, `track` apart.
RobotTree two_wheeler(double radius, double track);

/// Masses and shapes of a rover.
struct RoverBody {
  Vec3 chassis{0.35, 0.25, 0.12};  ///< m, lengths of the box
  double com_height = 0;           ///< m, of the chassis, above its middle
  Shape wheel = tyre(0.06);
  Inertia wheel_inertia;
};

/// Returns a rover on z = 0 with its base at 0.09 m, a chassis of 4 kg, wheels of radius 0.06 m and 0.3 kg at x =
/// +-0.12, y = +-0.15 m, joints "front_left_joint", "front_right_joint", "rear_left_joint", "rear_right_joint".
RobotTree rover(const RoverBody& body, double friction);

}  // namespace muro::test
