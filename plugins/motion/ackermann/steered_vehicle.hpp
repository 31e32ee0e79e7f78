// SPDX-License-Identifier: MIT
// One vehicle with steered wheels during a step.
#pragma once

#include <algorithm>

#include "muro/handles.hpp"
#include "plugins/common/wheels/gauss.hpp"
#include "plugins/common/wheels/ramp.hpp"
#include "plugins/common/wheels/rolling.hpp"

namespace muro::wheeled {

/// A joint that steers: it goes to its target at a constant rate and stops there.
struct Steering {
  In<double> target;
  Out<double> position, velocity;
  JointLimits limits;
  double max_rate = 0;  ///< rad/s, of the joint and of the user
  // of the present step
  double from = 0, rate = 0;  ///< rad, rad/s
  double end = 0;             ///< s: when it stops
  double last = 0;            ///< rad, from then on

  void begin(double dt) {
    const double goal = std::clamp(*target, limits.lower, limits.upper);
    from = *position, rate = 0, end = 0, last = goal;
    if (max_rate >= unlimited || goal == from) return;
    rate = std::copysign(max_rate, goal - from);
    end = (goal - from) / rate;
    if (end > dt) end = dt, last = from + rate * dt;
  }
  void finish(double dt) const {
    *position = last;
    *velocity = end == dt ? rate : 0;
  }
  /// In a part of the step that begins at `begin` and in which nothing changes its course, at `t` in it.
  double rate_in(double begin) const { return end > begin ? rate : 0; }
  double angle_in(double begin, double t) const { return end > begin ? from + rate * t : last; }
};

struct VehicleWheel {
  PlanarWheel plane;
  std::int32_t steering = -1;  ///< among the vehicle's; -1: none
  double gain = 0;             ///< its heading by the angle of what steers it
  double straight = 0;         ///< rad: its heading where that is 0
  bool driven = false;
  double max_speed = 0;  ///< rad/s, when driven
  In<double> target{};   ///< when driven
  Out<double> position{}, velocity{};
  // of the present step
  Ramp ramp{};        ///< when driven
  Rolling rolling{};  ///< at the present instant
  double turned = 0;  ///< rad, when not driven

  void stand_at(double angle, double rate) {
    const double heading = straight + gain * angle;
    rolling.sine = std::sin(heading), rolling.cosine = std::cos(heading);
    rolling.rate = gain * rate;
  }
  /// rad/s of its joint when it does not slip along.
  double speed_at(const PlanarTwist& v) const {
    return plane.per_metre * plane.along(rolling.sine, rolling.cosine, v, rolling.rate);
  }
};

class SteeredVehicle {
 public:
  SteeredVehicle(const RollingBase& base, std::span<VehicleWheel> wheels, std::span<Steering> steering)
      : base_(base), wheels_(wheels), steering_(steering) {}

  /// Moves `pose` on by `dt` (s); returns the velocity at the end. Wheels have turned by `turned` or their ramps.
  /// `turn_rate`: rad/s, so far; says how small the parts must be.
  PlanarTwist move(Pose& pose, double turn_rate, double dt) {
    PlanarTwist velocity{0, 0, turn_rate};
    for (VehicleWheel& w : wheels_) w.turned = 0;
    for (double begin = 0, end = 0; begin < dt; begin = end) {  // from each change of course to the next
      end = dt;
      bool steers = false, speeds_up = false;
      for (const Steering& s : steering_) {
        if (s.end > begin && s.end < end) end = s.end;
        steers |= s.rate_in(begin) != 0;
      }
      for (const VehicleWheel& w : wheels_) {
        if (!w.driven) continue;
        if (w.ramp.end > begin && w.ramp.end < end) end = w.ramp.end;
        speeds_up |= w.ramp.acceleration_at(begin) != 0;
      }
      velocity = steers ? steer(pose, velocity.turn, begin, end) : roll(pose, begin, end, speeds_up);
    }
    return velocity;
  }

  /// The velocity at which all wheels roll as they stand and turn.
  Allowed velocity() const {
    return base_.velocity(
        wheels_.size(), [&](std::size_t i) -> const PlanarWheel& { return wheels_[i].plane; },
        [&](std::size_t i) -> const Rolling& { return wheels_[i].rolling; },
        [&](std::size_t i) { return wheels_[i].driven; });
  }

 private:
  /// The same at `t` in the part of the step that begins at `begin`.
  Allowed velocity(double begin, double t) {
    stand(begin, t);
    return velocity();
  }
  void stand(double begin, double t) {
    for (VehicleWheel& w : wheels_) {
      if (w.steering >= 0) {
        const Steering& s = steering_[std::size_t(w.steering)];
        w.stand_at(s.angle_in(begin, t), s.rate_in(begin));
      }
      if (w.driven)
        w.rolling.speed = (w.ramp.at(begin) + w.ramp.acceleration_at(begin) * (t - begin)) / w.plane.per_metre;
    }
  }

  /// The wheels keep their angles: the centre of rotation stays, so the path is an arc however they speed up.
  PlanarTwist roll(Pose& pose, double begin, double end, bool speeds_up) {
    const double dt = end - begin;
    const Allowed middle = velocity(begin, begin + 0.5 * dt);
    for (VehicleWheel& w : wheels_)
      if (!w.driven) w.turned += w.speed_at(middle.velocity) * dt;
    if (!speeds_up) {
      pose = pose * arc(middle.velocity, dt);
      return middle.velocity;
    }
    const PlanarTwist last = velocity(begin, end).velocity;
    const PlanarTwist first = middle.velocity * 2 + last * -1;
    pose = pose * (middle.one_way ? arc(middle.velocity, dt) : curve(first, (last + first * -1) * (1 / dt), dt));
    return last;
  }

  /// Wheels are being steered: small parts by collocation of order 4, others, of at most 0.1 rad of steering and 0.5
  /// rad of turning, by that of order 10.
  PlanarTwist steer(Pose& pose, double turn_rate, double begin, double end) {
    const PlanarTwist last = velocity(begin, end).velocity;
    double steered = 0;
    for (const VehicleWheel& w : wheels_) steered = std::max(steered, std::abs(w.rolling.rate));
    steered *= end - begin;
    const double turned = std::max(std::abs(turn_rate), std::abs(last.turn)) * (end - begin);
    if (steered <= 0.01 && turned <= 0.02) {
      collocate(gauss_2, pose, begin, begin, end - begin);
    } else {
      const int count = 1 + int(std::min(std::max(10 * steered, 2 * turned), 1e4));
      const double dt = (end - begin) / count;
      for (int part = 0; part < count; ++part) collocate(gauss_5, pose, begin, begin + part * dt, dt);
    }
    stand(begin, end);
    return last;
  }

  template <int N>
  void collocate(const Gauss<N>& rule, Pose& pose, double begin, double from, double dt) {
    PlanarTwist v[N];
    double angle = 0;
    for (int i = 0; i < N; ++i) {
      v[i] = velocity(begin, from + rule.at[i] * dt).velocity;
      angle += rule.weight[i] * v[i].turn * dt;
      for (VehicleWheel& w : wheels_)
        if (!w.driven) w.turned += rule.weight[i] * w.speed_at(v[i]) * dt;
    }
    Vec3 way = Vec3::Zero();
    for (int i = 0; i < N; ++i) {
      double heading = 0;
      for (int j = 0; j < N; ++j) heading += rule.until[i][j] * v[j].turn * dt;
      const double s = std::sin(heading), c = std::cos(heading), h = rule.weight[i] * dt;
      way += Vec3(h * (c * v[i].x - s * v[i].y), h * (s * v[i].x + c * v[i].y), 0);
    }
    pose = pose * Pose{way, Quat(std::cos(0.5 * angle), 0, 0, std::sin(0.5 * angle))};
  }

  const RollingBase& base_;
  std::span<VehicleWheel> wheels_;
  std::span<Steering> steering_;
};

}  // namespace muro::wheeled
