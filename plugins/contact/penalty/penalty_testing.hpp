// SPDX-License-Identifier: MIT
// Bodies and scenes of the tests of contact.penalty: the real chain of index, collision, contact and motion.
#pragma once

#include "tests/support/wheeled_robot.hpp"

namespace muro::test {

inline constexpr double g = 9.81;

/// Returns a rover of 5.2 kg with cylinders as wheels.
inline RobotTree rover(double friction, double com_height = 0) {
  const double m = 0.3, r = 0.06, l = 0.04, across = m * (3 * r * r + l * l) / 12;
  return rover({.com_height = com_height,
                .wheel = tyre(r, l),
                .wheel_inertia = {.mass = m, .ixx = across, .iyy = m * r * r / 2, .izz = across}},
               friction);
}

struct ContactScene : Scene {
  /// Connects and starts. All robots move by motion.simplified.
  void start(double rate = 1000, double frequency = 50) {
    use("motion.simplified", rate, all_robots());
    use_contacts({{"frequency", frequency}});
    build();
  }
  /// Adds a wall or table: an axis-aligned box.
  void add_box(std::string_view name, const Vec3& centre, const Vec3& size, double friction) {
    const Shape box = with(Shape::box(size), friction);
    world().add_scenery(name, {centre, Quat::Identity()}, std::span<const Shape>(&box, 1));
  }
  /// Sets the wheel speeds of a rover, rad/s.
  void wheels(const std::string& robot, double left, double right) {
    for (const char* joint : {"/front_left_joint", "/rear_left_joint"})
      world().value(robot + joint, keys::joint_velocity_target) = left;
    for (const char* joint : {"/front_right_joint", "/rear_right_joint"})
      world().value(robot + joint, keys::joint_velocity_target) = right;
  }
  /// Returns the sum of the external wrenches on the base of a robot.
  Wrench external(const RobotView& robot) {
    return SumIn<Wrench>(world().store().find(robot.base(), "wrench.external")->sum).value();
  }
  std::span<Contact> contacts(const RobotView& robot) { return world().values(robot.base(), keys::contacts); }
};

}  // namespace muro::test
