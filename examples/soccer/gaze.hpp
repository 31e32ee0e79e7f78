// SPDX-License-Identifier: MIT
// Direction of the head: to the ball while it is in sight, with glances up to other objects on the field; around while
// the ball is out of sight.
#pragma once

#include <cstdint>
#include <numbers>

#include "camera_view.hpp"

namespace soccer {

/// Angles of the neck: rad, pan to the left, tilt down.
struct Neck {
  double pan = 0, tilt = 0;
};

class Gaze {
 public:
  /// Returns the angles while the ball is seen at a pixel, `distance` (m) away. `seconds`: since the last picture.
  Neck follow(const Neck& neck, const Pixel& ball, const Lens& lens, double distance, double seconds) {
    constexpr double gain = 0.7;  // share of the way to the ball from picture to picture
    at_ball_ = {neck.pan + gain * muro_atan2(lens.cx - ball.u, lens.fx),
                neck.tilt + gain * muro_atan2(ball.v - lens.cy, lens.fy)};
    waited_ = 0;
    if (is_glancing()) return glance(seconds);
    rested_ += seconds;
    const bool is_calm = distance > nearest && distance < farthest;
    return is_calm && rested_ > between_glances ? begin_glance() : at_ball_;
  }
  /// Returns the angles while the ball is out of sight.
  Neck search(double seconds) {
    if (is_glancing()) return glance(seconds);
    waited_ += seconds;
    if (waited_ < patience) return at_ball_;
    sweep_ += seconds / sweep_period;
    return {sweep * muro_sin(2 * std::numbers::pi * sweep_), tilts[std::int64_t(sweep_) % 3]};
  }

 private:
  static constexpr double patience = 0.9;               ///< s: time to wait for the ball where it was
  static constexpr double sweep = 1.2;                  ///< rad: to each side, when it looks around
  static constexpr double sweep_period = 3;             ///< s
  static constexpr double tilts[] = {0.9, 0.25, 0.6};   ///< rad, tilts of the sweeps, near and far
  static constexpr double nearest = 0.7, farthest = 4;  ///< m: distances of the ball that permit a glance
  static constexpr double between_glances = 4;          ///< s
  static constexpr double glance_length = 0.7;          ///< s
  static constexpr double glance_tilt = 0.15;           ///< rad
  static constexpr double aside = 0.6;  ///< rad: pan of glances, to the left, to the right and ahead in turns

  bool is_glancing() const { return left_ > 0; }
  Neck begin_glance() {
    rested_ = 0, left_ = glance_length, ++glances_;
    return glance(0);
  }
  Neck glance(double seconds) {
    left_ -= seconds;
    if (left_ <= 0) return at_ball_;
    constexpr double sides[] = {0, 1, -1};
    return {aside * sides[glances_ % 3], glance_tilt};
  }

  Neck at_ball_;         ///< angles at which the ball was seen last
  double waited_ = 1e3;  ///< s: time since the ball was lost
  double sweep_ = 0;     ///< periods
  double rested_ = 0;    ///< s: since the last glance
  double left_ = 0;      ///< s: remaining time of a glance
  std::int64_t glances_ = 0;
};

}  // namespace soccer
