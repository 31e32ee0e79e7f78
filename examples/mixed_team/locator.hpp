// SPDX-License-Identifier: MIT
// Place of a robot by satellite navigation, by the velocity from its wheels or from the receiver, and by the heading of
// its IMU: dead reckoning, corrected towards each new fix.
#pragma once

#include <span>

#include "../common/angle.hpp"
#include "../common/place.hpp"

namespace mixed_team {

using examples::Place;
using examples::Point;

class Locator {
 public:
  /// `fix`: gps.position, m; `velocity`: gps.velocity, m/s, both east, north, up; `orientation`: x, y, z, w;
  /// `odometry`: velocity in the axes of the base, or empty; `period`: s.
  void step(std::span<const double> fix, std::span<const double> velocity, std::span<const double> orientation,
            std::span<const double> odometry, double period) {
    yaw_ = examples::yaw_of(orientation);
    if (started_ == 0) {
      at_ = {fix[0], fix[1]}, height_ = fix[2];
      started_ = 1;
    } else {
      const Point rolled =
          odometry.empty() ? Point{velocity[0], velocity[1]} : turned(Point{odometry[0], odometry[1]}, yaw_);
      at_ = at_ + period * rolled;
      height_ += period * velocity[2];
      constexpr double trust = 0.3;  // share of the error that a new fix corrects
      const bool is_new = fix[0] != fix_[0] || fix[1] != fix_[1] || fix[2] != fix_[2];
      if (is_new) {
        at_ = at_ + trust * (Point{fix[0], fix[1]} - at_);
        height_ += trust * (fix[2] - height_);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) fix_[i] = fix[i];
  }

  const Point& at() const { return at_; }    ///< m
  double height() const { return height_; }  ///< m, above the origin of the map
  double yaw() const { return yaw_; }        ///< rad
  /// Converts a point from the axes of the robot to the map, and back.
  Point to_map(const Point& p) const { return Place{at_, yaw_}.to_world(p); }
  Point to_own(const Point& p) const { return Place{at_, yaw_}.to_own(p); }

 private:
  Point at_;
  double height_ = 0, yaw_ = 0, started_ = 0;
  double fix_[3] = {0, 0, 0};
};

}  // namespace mixed_team
