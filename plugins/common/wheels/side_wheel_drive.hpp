// SPDX-License-Identifier: MIT
// Conversion of the commanded velocity of a base to the speeds of its left and right wheels: the inverse of
// motion.differential_drive. It is the base of drive.differential and drive.skid_steer.
#pragma once

#include "drive_target.hpp"
#include "motion_description.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "side_wheels.hpp"

namespace muro::wheels {

inline constexpr PropertyUse side_wheel_drive_reads[] = {{"command.twist", "of the base: linear x and angular z"},
                                                         reads_wheel_shapes};
inline constexpr PropertyUse side_wheel_drive_writes[] = {{"joint.velocity.target", "of every driven wheel"}};

/// Data of a robot.
struct SideWheelRobot {
  /// speed = per_forward * forward + per_yaw * yaw_rate
  struct Wheel {
    DriveTarget target;
    double per_forward = 0;  ///< rad/m
    double per_yaw = 0;      ///< rad/rad
  };
  In<Twist> command;
  Range wheels;
};

class SideWheelDrive : public PerRobotAlgorithm<SideWheelRobot> {
 public:
  void step(const Step&, Range range) override {
    for (const SideWheelRobot& r : robots(range)) {
      const double forward = r.command->linear.x(), yaw_rate = r.command->angular.z();
      const std::span<SideWheelRobot::Wheel> wheels = wheels_[r.wheels];
      for (const SideWheelRobot::Wheel& w : wheels) *w.target.speed = w.per_forward * forward + w.per_yaw * yaw_rate;
      limit_speeds(wheels);
    }
  }

 protected:
  /// Returns the ratio of the effective track to the track of the wheels.
  virtual double track_scale(const Parameters&) const { return 1; }

 private:
  SideWheelRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& robot = *item.robot;
    const SideWheels found = find_side_wheels(c, robot);
    SideWheelRobot r;
    r.command = c.input(robot.base(), keys::command_twist, Twist{});
    std::vector<SideWheelRobot::Wheel> wheels;
    const double half_track = 0.5 * track_scale(c.parameters()) * found.track;
    for (const bool is_left : {true, false})
      for (const Wheel& w : is_left ? found.left : found.right) {
        const double per_metre = w.direction / w.radius;
        const double y = found.middle.y() + (is_left ? half_track : -half_track);
        wheels.push_back({connect_drive_target(c, robot, w.link, w.limits), per_metre, -y * per_metre});
      }
    r.wheels = wheels_.add(wheels);
    return r;
  }

  PackedLists<SideWheelRobot::Wheel> wheels_;
};

}  // namespace muro::wheels
