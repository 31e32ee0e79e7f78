// SPDX-License-Identifier: MIT
// Motion of one vehicle with steered wheels during a step.
#pragma once

#include <algorithm>

#include "muro/base/elementary.hpp"
#include "muro/handles.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/wheels/gauss_collocation.hpp"
#include "plugins/common/wheels/steering_geometry.hpp"
#include "plugins/common/wheels/velocity_ramp.hpp"

namespace muro::wheels {

/// A steering joint: it moves to its target at a constant rate and stops there.
struct SteeringJoint {
  In<double> target;
  Out<double> position, velocity;
  JointLimits limits;
  double max_rate = 0;  ///< rad/s, limit of the joint and of the user
  // of the present step
  double initial = 0, rate = 0;  ///< rad, rad/s
  double end = 0;                ///< s: time when it stops
  double final = 0;              ///< rad: position after that time

  void begin(double dt) {
    const double goal = std::clamp(*target, limits.lower, limits.upper);
    initial = *position, rate = 0, end = 0, final = goal;
    if (max_rate >= unlimited || goal == initial) return;
    rate = std::copysign(max_rate, goal - initial);
    end = (goal - initial) / rate;
    if (end > dt) end = dt, final = initial + rate * dt;
  }
  void finish(double dt) const {
    *position = final;
    *velocity = end == dt ? rate : 0;
  }
  /// Returns the rate in an interval of the step that starts at `start` and in which no joint stops; angle_in(): the
  /// angle at its time `t`.
  double rate_in(double start) const { return end > start ? rate : 0; }
  double angle_in(double start, double t) const { return end > start ? initial + rate * t : final; }
};

struct VehicleWheel {
  PlanarWheel plane;
  WheelSteering steering{};
  bool is_driven = false;
  double max_speed = 0;  ///< rad/s, when driven
  In<double> target{};   ///< when driven
  Out<double> position{}, velocity{};
  // of the present step
  VelocityRamp ramp{};      ///< when driven
  WheelState state{};       ///< at the present instant
  double rolled_angle = 0;  ///< rad, when not driven

  /// Sets the heading for a steering joint at `angle` that turns at `rate`.
  void steer(double angle, double rate) {
    const double heading = steering.zero_heading + steering.gain * angle;
    const auto [sine, cosine] = elementary::sincos(heading);
    state.sine = sine, state.cosine = cosine;
    state.steering_rate = steering.gain * rate;
  }
  /// Returns the rate (rad/s) of its joint when it does not slip along its rolling direction.
  double speed_at(const PlanarTwist& v) const {
    return plane.angle_per_metre * plane.longitudinal_velocity(state.sine, state.cosine, v, state.steering_rate);
  }
};

class SteeredVehicle {
 public:
  SteeredVehicle(const RollingConstraints& constraints, std::span<VehicleWheel> wheels,
                 std::span<SteeringJoint> steering)
      : constraints_(constraints), wheels_(wheels), steering_(steering) {}

  /// Advances `pose` by `dt` (s) and returns the velocity at the end. Wheels have then turned by `rolled_angle` or
  /// their ramps. `yaw_rate`: rad/s, the present one, from which the size of the intervals follows. They are at most
  /// `longest` (s) long; `settle(before, pose)` is called at the end of each.
  template <class Settle>
  PlanarTwist move(Pose& pose, double yaw_rate, double dt, double longest, const Settle& settle) {
    PlanarTwist velocity{0, 0, yaw_rate};
    for (VehicleWheel& w : wheels_) w.rolled_angle = 0;
    for (double start = 0, end = 0; start < dt; start = end) {  // from each end of a ramp to the next
      end = std::min(dt, start + longest);
      const Pose before = pose;
      bool steers = false, speeds_up = false;
      for (const SteeringJoint& s : steering_) {
        if (s.end > start && s.end < end) end = s.end;
        steers |= s.rate_in(start) != 0;
      }
      for (const VehicleWheel& w : wheels_) {
        if (!w.is_driven) continue;
        if (w.ramp.end > start && w.ramp.end < end) end = w.ramp.end;
        speeds_up |= w.ramp.acceleration_at(start) != 0;
      }
      velocity =
          steers ? move_while_steering(pose, velocity.yaw_rate, start, end) : move_on_arc(pose, start, end, speeds_up);
      settle(before, pose);
    }
    return velocity;
  }

  /// Returns the motion in which all wheels roll at their present headings and speeds.
  RollingMotion motion() const {
    return constraints_.motion(
        wheels_.size(), [&](std::size_t i) -> const PlanarWheel& { return wheels_[i].plane; },
        [&](std::size_t i) -> const WheelState& { return wheels_[i].state; },
        [&](std::size_t i) { return wheels_[i].is_driven; });
  }

 private:
  /// Returns the motion at `t` in the interval of the step that starts at `start`.
  RollingMotion motion(double start, double t) {
    set_wheels(start, t);
    return motion();
  }
  void set_wheels(double start, double t) {
    for (VehicleWheel& w : wheels_) {
      if (w.steering.joint >= 0) {
        const SteeringJoint& s = steering_[std::size_t(w.steering.joint)];
        w.steer(s.angle_in(start, t), s.rate_in(start));
      }
      if (w.is_driven)
        w.state.speed =
            (w.ramp.velocity_at(start) + w.ramp.acceleration_at(start) * (t - start)) / w.plane.angle_per_metre;
    }
  }

  /// Moves along an arc. The wheels keep their headings and so the centre of rotation stays, whatever the wheels'
  /// accelerations are.
  PlanarTwist move_on_arc(Pose& pose, double start, double end, bool speeds_up) {
    const double dt = end - start;
    const RollingMotion middle = motion(start, start + 0.5 * dt);
    for (VehicleWheel& w : wheels_)
      if (!w.is_driven) w.rolled_angle += w.speed_at(middle.velocity) * dt;
    if (!speeds_up) {
      pose = pose * arc(middle.velocity, dt);
      return middle.velocity;
    }
    const PlanarTwist last = motion(start, end).velocity;
    const PlanarTwist first = middle.velocity * 2 + last * -1;
    pose = pose * (middle.degree_of_mobility == 1 ? arc(middle.velocity, dt)
                                                  : accelerated_arc(first, (last + first * -1) * (1 / dt), dt));
    return last;
  }

  /// Moves while wheels are being steered. Short intervals use collocation of order 4. Others are cut to at most 0.1
  /// rad of steering and 0.5 rad of turning, and use collocation of order 10.
  PlanarTwist move_while_steering(Pose& pose, double yaw_rate, double start, double end) {
    const PlanarTwist last = motion(start, end).velocity;
    double steered = 0;
    for (const VehicleWheel& w : wheels_) steered = std::max(steered, std::abs(w.state.steering_rate));
    steered *= end - start;
    const double turned = std::max(std::abs(yaw_rate), std::abs(last.yaw_rate)) * (end - start);
    if (steered <= 0.01 && turned <= 0.02) {
      collocate(gauss_2, pose, start, start, end - start);
    } else {
      const int count = 1 + int(std::min(std::max(10 * steered, 2 * turned), 1e4));
      const double dt = (end - start) / count;
      for (int i = 0; i < count; ++i) collocate(gauss_5, pose, start, start + i * dt, dt);
    }
    set_wheels(start, end);
    return last;
  }

  template <int N>
  void collocate(const GaussCollocation<N>& rule, Pose& pose, double start, double from, double dt) {
    PlanarTwist v[N];
    double angle = 0;
    for (int i = 0; i < N; ++i) {
      v[i] = motion(start, from + rule.node[i] * dt).velocity;
      angle += rule.weight[i] * v[i].yaw_rate * dt;
      for (VehicleWheel& w : wheels_)
        if (!w.is_driven) w.rolled_angle += rule.weight[i] * w.speed_at(v[i]) * dt;
    }
    Vec3 displacement = Vec3::Zero();
    for (int i = 0; i < N; ++i) {
      double heading = 0;
      for (int j = 0; j < N; ++j) heading += rule.matrix[i][j] * v[j].yaw_rate * dt;
      const auto [s, c] = elementary::sincos(heading);
      const double h = rule.weight[i] * dt;
      displacement += Vec3(h * (c * v[i].x - s * v[i].y), h * (s * v[i].x + c * v[i].y), 0);
    }
    pose = pose * Pose{displacement, rotation_about(Vec3::UnitZ(), angle)};
  }

  const RollingConstraints& constraints_;
  std::span<VehicleWheel> wheels_;
  std::span<SteeringJoint> steering_;
};

}  // namespace muro::wheels
