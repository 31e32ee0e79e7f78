// SPDX-License-Identifier: MIT
// Vehicles with steered wheels, for tests.
#pragma once

#include <random>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::ackermann {

using Settings = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;
inline constexpr double wide_angle = 1.4;

/// A wheel of a test's vehicle: "NAME_wheel_joint", and "NAME_steering_joint" when it is steered.
struct WheelSpec {
  std::string name;
  Vec3 at;  ///< m, position of the steering joint, or of an unsteered wheel
  bool steered = false;
  double radius = 0.1;
  Vec3 arm = Vec3::Zero();  ///< m, from the steering joint to the wheel
  Vec3 axis = Vec3::UnitY();
  Vec3 upright = Vec3::UnitZ();
  JointLimits steering{.lower = -wide_angle, .upper = wide_angle};
  JointLimits wheel{};
  std::string leader{};  ///< joint that the steering joint mimics
  double multiplier = 1;
};

inline RobotTree vehicle_of(
    const std::vector<WheelSpec>& wheels, const std::function<void(RobotBuilder&)>& more = [](RobotBuilder&) {}) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    for (const WheelSpec& p : wheels) {
      const Shape tyre = test::tyre(p.radius);
      b.fork();
      b.translation(p.at);
      if (p.steered) {
        b.revolute(p.name + "_steering_joint", p.upright, p.steering);
        if (!p.leader.empty()) b.mimic(p.leader, p.multiplier, 0);
        b.body(p.name + "_knuckle");
        b.translation(p.arm);
      }
      b.revolute(p.name + "_wheel_joint", p.axis, p.wheel);
      b.body(p.name + "_wheel");
      b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
      b.end();
    }
    more(b);
    for (std::size_t i = 0; i < wheels.size(); ++i) b.end();
  });
}

inline std::vector<WheelSpec> bicycle(double wheelbase) {
  return {{.name = "rear", .at = {0, 0, 0}}, {.name = "front", .at = {wheelbase, 0, 0}, .steered = true}};
}
/// A car with driven rear wheels and steered front wheels; the steering joints are `scrub` (m) inside of the wheels.
inline std::vector<WheelSpec> car(double wheelbase, double track, double scrub = 0) {
  std::vector<WheelSpec> wheels;
  for (const double side : {0.5, -0.5}) {
    const std::string end = side > 0 ? "_left" : "_right";
    wheels.push_back({.name = "rear" + end, .at = {0, side * track, 0}});
    wheels.push_back({.name = "front" + end,
                      .at = {wheelbase, side * (track - 2 * scrub), 0},
                      .steered = true,
                      .arm = {0, 2 * side * scrub, 0}});
  }
  return wheels;
}

struct Vehicle : test::Scene {
  const RobotView& robot;
  Vehicle(double rate, const RobotTree& tree, Settings settings = {}, const Pose& start = {}, const Twist& moving = {})
      : robot(add("car", tree, start, moving)) {
    use("motion.ackermann", rate, all_robots(), std::move(settings));
    use("kinematics.direct", 2 * rate, all_robots());  // every other run sees the end of a step
    build();
  }
  Vehicle(double rate, const std::vector<WheelSpec>& wheels, Settings settings = {}, const Pose& start = {},
          const Twist& moving = {})
      : Vehicle(rate, vehicle_of(wheels), std::move(settings), start, moving) {}

  double& value(const std::string& joint, const Key<double>& key) {
    return world().value("car/" + joint + "_joint", key);
  }
  void steer(const std::string& wheel, double angle) {
    value(wheel + "_steering", keys::joint_position_target) = angle;
  }
  void drive(const std::string& wheel, double speed) { value(wheel + "_wheel", keys::joint_velocity_target) = speed; }
  double turned(const std::string& wheel) { return value(wheel + "_wheel", keys::joint_position); }
  double turning(const std::string& wheel) { return value(wheel + "_wheel", keys::joint_velocity); }
  double& angle(const std::string& wheel) { return value(wheel + "_steering", keys::joint_position); }
  Pose& at() { return pose(robot); }
  Twist& moving() { return twist(robot); }
  double yaw() { return yaw_of(at().orientation); }
  /// Returns the velocity (m/s) of the lowest point of a wheel: 0 when it rolls.
  Vec3 slip(const WheelSpec& p) {
    return world().value("car/" + p.name + "_wheel", keys::twist).at(at().orientation * Vec3(0, 0, -p.radius));
  }
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vec3 vector(double limit) { return {(*this)(-limit, limit), (*this)(-limit, limit), (*this)(-limit, limit)}; }
};

}  // namespace muro::ackermann
