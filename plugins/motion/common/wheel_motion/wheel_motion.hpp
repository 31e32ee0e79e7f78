// SPDX-License-Identifier: MIT
// Motion of vehicles for which the velocity of the base is linear in the speeds of their wheels.
#pragma once

#include "muro/plugin.hpp"
#include "muro/toolkit/contact_stop.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/wheels/motion_description.hpp"
#include "plugins/common/wheels/non_wheel_joints.hpp"
#include "plugins/common/wheels/parameters.hpp"
#include "plugins/common/wheels/planar_motion.hpp"
#include "plugins/common/wheels/terrain_travel.hpp"
#include "plugins/common/wheels/velocity_ramp.hpp"
#include "plugins/motion/common/motion/description.hpp"
#include "plugins/motion/common/motion/motion.hpp"

namespace muro::wheels {

inline constexpr PropertyUse wheel_motion_reads[] = {
    {"joint.velocity.target", "of every joint that follows no other"},
    reads_initial_pose,
    reads_initial_twist,
    reads_initial_positions,
    reads_wheel_shapes,
    on_contact_reads,
};
inline constexpr Features wheel_motion_features = feature_joints | feature_velocity_targets | feature_joint_limits |
                                                  feature_joint_speed_limits | feature_mimic_joints |
                                                  feature_heightmaps;

/// A driven wheel, in the frame of its base.
struct WheelJacobian {
  std::uint32_t link = 0;      ///< of the robot
  double max_speed = 0;        ///< rad/s
  PlanarTwist column;          ///< of the Jacobian: velocity of the base per rad/s of the wheel's joint
  PlanarTwist inverse_row;     ///< rad/s of the joint per m/s along x, m/s along y and rad/s of the base
  Vec3 lowest = Vec3::Zero();  ///< m: the point that stands on the ground
  double radius = 0;           ///< m

  double speed_at(const PlanarTwist& v) const { return std::clamp(dot(inverse_row, v), -max_speed, max_speed); }
};

/// A wheel that turns towards its target.
struct RampedWheel {
  In<double> target;
  Out<double> position, velocity;
  WheelJacobian jacobian;
  VelocityRamp ramp;  ///< of the present step
};

/// Data of a robot.
struct WheeledRobot {
  Out<Pose> pose;
  Out<Twist> twist;
  Range wheels, contacts;
  NonWheelJoints::OfRobot other_joints;
  std::string_view name;
  ContactStop stop;
};

/// Common part of such motions. Each defines in `jacobian_of` the effect of its wheels. Their descriptions have the
/// parameters `max_wheel_acceleration` and `on_contact`.
class WheelMotion : public Motion<PerRobotAlgorithm<WheeledRobot>> {
 public:
  /// Turns the wheels in the way that fits the base's velocity best.
  void on_handover(std::uint32_t item) override {
    const WheeledRobot& r = robot(item);
    const PlanarTwist moving = in_plane(*r.pose, *r.twist);
    for (const RampedWheel& w : wheels_[r.wheels]) *w.velocity = w.jacobian.speed_at(moving);
  }

 protected:
  void move(const Step& step, Range range) override {
    for (const WheeledRobot& r : robots(range)) {
      const std::span<RampedWheel> wheels = wheels_[r.wheels];
      for (RampedWheel& w : wheels)
        w.ramp = velocity_ramp(*w.velocity, std::clamp(*w.target, -w.jacobian.max_speed, w.jacobian.max_speed),
                               max_acceleration_, step.dt);
      const Pose before = *r.pose;
      move_base(r, wheels, step.dt);
      const bool is_blocked = r.stop.blocks(before.position, *r.twist);
      if (is_blocked) *r.pose = before, *r.twist = {};
      for (const RampedWheel& w : wheels) {
        *w.position += is_blocked ? 0 : w.ramp.angle(step.dt);
        *w.velocity = is_blocked ? 0 : w.ramp.final;
      }
      other_joints_.move(r.other_joints, step.dt);
    }
  }

  virtual std::vector<WheelJacobian> jacobian_of(const Connector& c, const RobotView& robot) const = 0;

 private:
  void read_parameters(const Parameters& p) override { max_acceleration_ = p.real(max_wheel_acceleration.name); }

  WheeledRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& robot = *item.robot;
    Pose start = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist moving = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    const std::vector<double> positions = initial_joint_positions(c, robot);
    JointState state(robot);
    WheeledRobot r;
    r.name = robot.name;
    const std::vector<WheelJacobian> jacobian = jacobian_of(c, robot);
    r.contacts = terrain_.connect(c, robot, jacobian, positions);
    terrain_.settle(r.contacts, start, start);
    r.pose = c.variable(robot.base(), keys::pose, start);
    PlanarTwist velocity;
    std::vector<RampedWheel> wheels;
    for (const WheelJacobian& wheel : jacobian) {
      const ObjectId joint = robot.links[wheel.link].joint_object;
      const double speed = wheel.speed_at(in_plane(start, moving));
      RampedWheel w;
      w.jacobian = wheel;
      w.target = c.input(joint, keys::joint_velocity_target, 0.0);
      w.position = c.variable(joint, keys::joint_position, positions[wheel.link]);
      w.velocity = c.variable(joint, keys::joint_velocity, speed);
      state.bind(wheel.link, w);
      velocity = velocity + wheel.column * speed;
      wheels.push_back(w);
    }
    r.wheels = wheels_.add(wheels);
    r.twist = c.variable(robot.base(), keys::twist, terrain_.in_world(r.contacts, start, velocity));
    r.other_joints = other_joints_.connect(c, robot, positions, state);
    r.stop = ContactStop(c, robot, terrain_.ground());
    return r;
  }

  /// Moves the base. The speeds of all wheels are linear in time between the ends of their ramps. From each end to the
  /// next one the base moves on an arc or, while wheels accelerate, on an accelerated arc.
  void move_base(const WheeledRobot& r, std::span<const RampedWheel> wheels, double dt) const {
    Pose& pose = *r.pose;
    PlanarTwist velocity;
    const double longest = terrain_.follows() ? terrain_.longest_interval(fastest_along(wheels), dt) : dt;
    for (double from = 0, to = 0; from < dt; from = to) {
      to = std::min(dt, from + longest);
      const Pose before = pose;
      velocity = {};
      PlanarTwist acceleration;
      for (const RampedWheel& w : wheels) {
        velocity = velocity + w.jacobian.column * w.ramp.velocity_at(from);
        acceleration = acceleration + w.jacobian.column * w.ramp.acceleration_at(from);
        if (w.ramp.end > from && w.ramp.end < to) to = w.ramp.end;
      }
      pose = pose * (acceleration == PlanarTwist{} ? arc(velocity, to - from)
                                                   : accelerated_arc(velocity, acceleration, to - from));
      velocity = velocity + acceleration * (to - from);
      terrain_.settle(r.contacts, before, pose);
    }
    pose.orientation.normalize();
    *r.twist = terrain_.in_world(r.contacts, pose, velocity);
    if (!(std::abs(velocity.x) + std::abs(velocity.y) + std::abs(velocity.yaw_rate) < fastest))
      throw Error("a wheel of `" + std::string(r.name) +
                  "` is to turn at a speed that is not finite, or moves it faster than 1e12 m/s; look at what writes "
                  "`joint.velocity.target`");
  }

  /// Returns a limit (m/s) of the speed that wheels give the base in this step.
  static double fastest_along(std::span<const RampedWheel> wheels) {
    double sum = 0;
    for (const RampedWheel& w : wheels)
      sum += std::max(std::abs(w.ramp.initial), std::abs(w.ramp.final)) *
             (std::abs(w.jacobian.column.x) + std::abs(w.jacobian.column.y));
    return sum;
  }

  double max_acceleration_ = unlimited;
  TerrainTravel terrain_;
  PackedLists<RampedWheel> wheels_;
  NonWheelJoints other_joints_;
};

}  // namespace muro::wheels
