// SPDX-License-Identifier: MIT
// A city in the plane for tests of control code without the simulator: closed-form rays, unicycles, exact clearances.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "muro_controller.h"

namespace flat {

struct Point {
  double x = 0, y = 0;  ///< m
};

struct Pose2d {
  double x = 0, y = 0, heading = 0;  ///< m, m, rad

  Point to_world(const Point& p) const {
    const double c = std::cos(heading), s = std::sin(heading);
    return {x + c * p.x - s * p.y, y + s * p.x + c * p.y};
  }
  Point to_local(const Point& p) const {
    const double c = std::cos(heading), s = std::sin(heading);
    return {c * (p.x - x) + s * (p.y - y), -s * (p.x - x) + c * (p.y - y)};
  }
};

/// A rectangle: a building, a wall or a vehicle.
struct Box {
  Pose2d pose;
  double half_x = 0, half_y = 0;  ///< m

  /// Returns where a ray from `from` along `to` (unit) enters (m); infinite for a miss. Slabs: Kay, Kajiya 1986.
  double enter(const Point& from, const Point& to) const {
    const Point o = pose.to_local(from), ahead = pose.to_local({from.x + to.x, from.y + to.y});
    double near = 0, far = std::numeric_limits<double>::infinity();
    const auto cut = [&](double start, double step, double half) {
      if (step == 0) {
        if (std::abs(start) > half) near = std::numeric_limits<double>::infinity();
        return;
      }
      const double a = (-half - start) / step, b = (half - start) / step;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    };
    cut(o.x, ahead.x - o.x, half_x);
    cut(o.y, ahead.y - o.y, half_y);
    return near <= far ? near : std::numeric_limits<double>::infinity();
  }
  /// Returns the distance (m) to a point; 0 inside.
  double distance(const Point& p) const {
    const Point l = pose.to_local(p);
    return std::hypot(std::max(0.0, std::abs(l.x) - half_x), std::max(0.0, std::abs(l.y) - half_y));
  }
  std::vector<Point> corners() const {
    return {pose.to_world({half_x, half_y}), pose.to_world({-half_x, half_y}), pose.to_world({-half_x, -half_y}),
            pose.to_world({half_x, -half_y})};
  }
};

/// Returns the distance (m) of two rectangles: from a corner of one to the other, unless they overlap.
inline double distance(const Box& a, const Box& b) {
  double min = std::numeric_limits<double>::infinity();
  for (const Point& p : a.corners()) min = std::min(min, b.distance(p));
  for (const Point& p : b.corners()) min = std::min(min, a.distance(p));
  return min;
}

/// A unicycle of 0.4 m x 0.34 m with limited accelerations and a scanner of 240 degrees and 5.6 m.
class Vehicle {
 public:
  static constexpr int rays = 241;
  static constexpr double min_angle = -2 * M_PI / 3, increment = 4 * M_PI / 3 / (rays - 1), max_range = 5.6;
  static constexpr double laser_x = 0.1, period = 0.1;

  Vehicle(const muro_controller_table& control, const Pose2d& start, std::uint64_t seed,
          std::vector<const char*> arguments = {})
      : pose(start), control_(&control), state_(control.state_size / sizeof(std::max_align_t) + 1) {
    arguments.push_back(nullptr);
    const std::uint32_t sizes[] = {rays, 1, 1, 1};
    muro_controller_setup setup{};
    setup.robot = "vehicle";
    setup.period = period;
    setup.seed = seed;
    setup.input_sizes = sizes;
    setup.arguments = arguments.data();
    char error[256] = "";
    if (control.create(state_.data(), &setup, error, sizeof error) != 0) throw std::runtime_error(error);
  }

  Box body() const { return {pose, 0.2, 0.17}; }
  double speed() const { return speed_; }
  double distance_driven() const { return distance_driven_; }  ///< forward, m
  double turned() const { return turned_; }                    ///< to the left, rad

  /// Reads the scanner among `obstacles`, lets `disturb` change the reading, and lets the control code decide.
  template <class Disturb>
  void control(double time, const std::vector<const Box*>& obstacles, Disturb disturb) {
    const Point laser = pose.to_world({laser_x, 0});
    double ranges[rays];
    for (int i = 0; i < rays; ++i) {
      const double angle = pose.heading + min_angle + i * increment;
      const Point direction{std::cos(angle), std::sin(angle)};
      ranges[i] = max_range;
      for (const Box* b : obstacles) ranges[i] = std::min(ranges[i], b->enter(laser, direction));
      disturb(ranges[i]);
    }
    const double first = min_angle, step = increment, max = max_range;
    const double* inputs[] = {ranges, &first, &step, &max};
    double* outputs[] = {command_};
    muro_controller_step now{};
    now.time = time;
    now.inputs = inputs;
    now.outputs = outputs;
    char error[256] = "";
    if (control_->step(state_.data(), &now, error, sizeof error) != 0) throw std::runtime_error(error);
  }

  void control(double time, const std::vector<const Box*>& obstacles) {
    control(time, obstacles, [](double&) {});
  }

  /// Moves for `dt` (s): the velocities approach the command with at most 2 m/s^2 and 6 rad/s^2.
  void move(double dt) {
    speed_ += std::clamp(command_[0] - speed_, -2 * dt, 2 * dt);
    rate_ += std::clamp(command_[5] - rate_, -6 * dt, 6 * dt);
    const double middle = pose.heading + rate_ * dt / 2;
    pose.x += speed_ * dt * std::cos(middle);
    pose.y += speed_ * dt * std::sin(middle);
    pose.heading += rate_ * dt;
    distance_driven_ += std::max(0.0, speed_ * dt);
    turned_ += rate_ * dt;
  }

  Pose2d pose;

 private:
  const muro_controller_table* control_;
  std::vector<std::max_align_t> state_;
  double command_[6] = {};
  double speed_ = 0, rate_ = 0, distance_driven_ = 0, turned_ = 0;
};

/// Buildings of 6 m x 6 m in a grid of 10 m, streets of 4 m, closed by walls.
class City {
 public:
  City() = default;  ///< empty
  explicit City(int blocks) {
    const double half = 5.0 * blocks;
    for (int i = 0; i < blocks; ++i)
      for (int k = 0; k < blocks; ++k) boxes.push_back({{10 * i + 5 - half, 10 * k + 5 - half, 0}, 3, 3});
    const double edge = half + 2.2;
    for (const double side : {-1.0, 1.0}) {
      boxes.push_back({{side * edge, 0, 0}, 0.2, edge + 0.2});
      boxes.push_back({{0, side * edge, 0}, edge + 0.2, 0.2});
    }
  }

  /// Returns the boxes that a scanner at `p` may see.
  std::vector<const Box*> near(const Pose2d& p) const {
    std::vector<const Box*> found;
    for (const Box& b : boxes)
      if (b.distance({p.x, p.y}) < 6) found.push_back(&b);
    return found;
  }
  double clearance(const Vehicle& v) const {
    double min = std::numeric_limits<double>::infinity();
    for (const Box* b : near(v.pose)) min = std::min(min, distance(v.body(), *b));
    return min;
  }

  std::vector<Box> boxes;
};

}  // namespace flat
