// SPDX-License-Identifier: MIT
// Motion of vehicles whose base moves at a sum of shares, one of each wheel in proportion to its speed.
#pragma once

#include "description.hpp"
#include "muro/toolkit/contact_stop.hpp"
#include "other_joints.hpp"
#include "parameters.hpp"
#include "planar.hpp"
#include "ramp.hpp"

namespace muro::wheeled {

/// A driven wheel, in the frame of its base.
struct WheelShare {
  std::uint32_t frame = 0;
  double max_speed = 0;  ///< rad/s
  PlanarTwist share;     ///< of this wheel in the base's velocity, per rad/s of its joint
  PlanarTwist asks;      ///< rad/s of its joint per m/s along x, m/s along y and rad/s of the base

  double speed_at(const PlanarTwist& v) const {
    return std::clamp(asks.x * v.x + asks.y * v.y + asks.turn * v.turn, -max_speed, max_speed);
  }
};

/// What such motions have in common; each says in `shares_of` what its wheels do. Its descriptions have the parameters
/// `max_wheel_acceleration` and `on_contact`.
class WheelMotion : public Algorithm {
 public:
  void connect(Connector& c) override {
    max_acceleration_ = c.parameters().real(max_wheel_acceleration.name);
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it moves robots, but no robot is named");
      connect_robot(c, *item.robot);
    }
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const std::span<DrivenWheel> wheels = wheels_of(robots_[i]);
      for (DrivenWheel& w : wheels)
        w.ramp = ramp(*w.velocity, std::clamp(*w.target, -w.of.max_speed, w.of.max_speed), max_acceleration_, step.dt);
      const Robot& r = robots_[i];
      const Pose before = *r.pose;
      move_base(r, wheels, step.dt);
      const bool stopped = r.stop.blocks(before.position, *r.twist);
      if (stopped) *r.pose = before, *r.twist = {};
      for (const DrivenWheel& w : wheels) {
        *w.position += stopped ? 0 : w.ramp.angle(step.dt);
        *w.velocity = stopped ? 0 : w.ramp.last;
      }
      others_.move(i, step.dt);
    }
  }

  /// The wheels turn as fits the base's velocity best.
  void on_handover(std::uint32_t item) override {
    const Robot& r = robots_[item];
    const PlanarTwist moving = in_plane(*r.pose, *r.twist);
    for (const DrivenWheel& w : wheels_of(r)) *w.velocity = w.of.speed_at(moving);
  }

 protected:
  virtual std::vector<WheelShare> shares_of(const Connector& c, const RobotView& robot) const = 0;

 private:
  struct DrivenWheel {
    In<double> target;
    Out<double> position, velocity;
    WheelShare of;
    Ramp ramp;  ///< of the present step
  };
  struct Robot {
    Out<Pose> pose;
    Out<Twist> twist;
    Range wheels;  ///< in wheels_
    std::string_view name;
    ContactStop stop;
  };

  std::span<DrivenWheel> wheels_of(const Robot& r) {
    return {wheels_.data() + r.wheels.begin, r.wheels.end - r.wheels.begin};
  }

  void connect_robot(Connector& c, const RobotView& robot) {
    const Pose start = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist moving = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    const std::vector<double> positions = initial_joint_positions(c, robot);
    JointState state(robot);
    Robot r;
    r.name = robot.name;
    r.pose = c.variable(robot.base(), keys::pose, start);
    r.wheels.begin = std::uint32_t(wheels_.size());
    PlanarTwist rolling;
    for (const WheelShare& of : shares_of(c, robot)) {
      const ObjectId joint = robot.links[of.frame].joint_object;
      const double speed = of.speed_at(in_plane(start, moving));
      DrivenWheel w;
      w.of = of;
      w.target = c.input(joint, keys::joint_velocity_target, 0.0);
      w.position = state.position[of.frame] = c.variable(joint, keys::joint_position, positions[of.frame]);
      w.velocity = state.velocity[of.frame] = c.variable(joint, keys::joint_velocity, speed);
      rolling = rolling + of.share * speed;
      wheels_.push_back(w);
    }
    r.wheels.end = std::uint32_t(wheels_.size());
    r.twist = c.variable(robot.base(), keys::twist, in_world(start, rolling));
    others_.connect(c, robot, positions, state);
    r.stop = ContactStop(c, robot);
    robots_.push_back(r);
  }

  /// All wheels' velocities are linear in time between the ends of their ramps: from each end to the next one goes an
  /// arc, or, while wheels speed up, a curve.
  static void move_base(const Robot& r, std::span<const DrivenWheel> wheels, double dt) {
    Pose& pose = *r.pose;
    PlanarTwist velocity;
    for (double from = 0, to = 0; from < dt; from = to) {
      to = dt;
      velocity = {};
      PlanarTwist rate;
      for (const DrivenWheel& w : wheels) {
        velocity = velocity + w.of.share * w.ramp.at(from);
        rate = rate + w.of.share * w.ramp.acceleration_at(from);
        if (w.ramp.end > from && w.ramp.end < to) to = w.ramp.end;
      }
      pose = pose * (rate == PlanarTwist{} ? arc(velocity, to - from) : curve(velocity, rate, to - from));
      velocity = velocity + rate * (to - from);
    }
    pose.orientation.normalize();
    *r.twist = in_world(pose, velocity);
    if (!std::isfinite(velocity.x + velocity.y + velocity.turn))
      throw Error("a wheel of `" + std::string(r.name) +
                  "` is to turn at a speed that is not finite; look at what writes "
                  "`joint.velocity.target`");
  }

  double max_acceleration_ = unlimited;
  std::vector<Robot> robots_;
  std::vector<DrivenWheel> wheels_;
  OtherJoints others_;
};

}  // namespace muro::wheeled
