// SPDX-License-Identifier: MIT
// Attitude of the trunk from gyroscope and accelerometer: a complementary filter on the direction of "up" (Mahony,
// Hamel and Pflimlin, IEEE TAC 2008), and the yaw as the integral of the gyroscope. The bias of the gyroscope is its
// mean while the robot stands still.
#pragma once

#include <cmath>
#include <cstdint>

#include "frame.hpp"
#include "pendulum.hpp"

namespace walking {

class Attitude {
 public:
  /// Takes one reading, `h` s after the last one: rad/s and m/s^2 (specific force), in the axes of the trunk. `gain`,
  /// 1/s: rate at which the filter follows the accelerometer.
  void update(const Vector& rate, const Vector& force, double gain, double h) {
    rate_ = rate - rate_bias_;
    const Vector f = (1 / gravity) * (force - force_bias_);
    if (!begun_ && f.norm() > 0.5) up_ = (1 / f.norm()) * f, begun_ = 1;
    if (!begun_) return;
    // up is fixed in the world, and the mean specific force points along it; its component along up is no information
    up_ = up_ + h * cross(up_, rate_) + (gain * h) * (f - dot(up_, f) * up_);
    up_ = (1 / up_.norm()) * up_;
    const double level = std::sqrt(up_.y * up_.y + up_.z * up_.z);
    if (level > 0.3) yaw_ += h * (rate_.y * up_.y + rate_.z * up_.z) / (level * level);
  }
  /// Takes a reading while the robot stands still and its legs give `up` (in the axes of the trunk). Biases are the
  /// means of the errors of the sensors.
  void calibrate(const Vector& rate, const Vector& force, const Vector& up) {
    const double part = 1 / double(++still_readings_);
    rate_bias_ = rate_bias_ + part * (rate - rate_bias_);
    force_bias_ = force_bias_ + part * (force - gravity * up - force_bias_);
    up_ = up, begun_ = 1, yaw_ = 0;
  }

  const Vector& up() const { return up_; }      ///< in the axes of the trunk
  const Vector& rate() const { return rate_; }  ///< rad/s, without bias
  double yaw() const { return yaw_; }           ///< rad, since the start
  double pitch() const { return muro_atan2(-up_.x, std::sqrt(up_.y * up_.y + up_.z * up_.z)); }  ///< rad, nose down
  double roll() const { return muro_atan2(up_.y, up_.z); }              ///< rad, right side down
  Rotation tilt() const { return about_y(pitch()) * about_x(roll()); }  ///< tilt of the trunk, without yaw

 private:
  Vector up_{0, 0, 1}, rate_, rate_bias_, force_bias_;
  double yaw_ = 0;
  std::int64_t still_readings_ = 0, begun_ = 0;
};

}  // namespace walking
