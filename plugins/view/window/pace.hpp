// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>

namespace muro::view {

/// Decides by the wall clock when simulated time may go on: at a speed, paused, or one step at a time. All times in s.
class Pace {
 public:
  /// `speed`: simulated seconds per second; 0: as fast as possible.
  Pace(double speed, bool paused) : speed_(speed), paused_(paused) {}

  /// Whether the run may leave the instant `simulated` now.
  bool may_go_on(double simulated, double wall) {
    if (!has_begun_) begin(simulated, wall);
    if (paused_) {
      begin(simulated, wall);
      if (!stepping_) return false;
      stepping_ = false;
      return true;
    }
    if (speed_ <= 0) return true;
    const double due = from_wall_ + (simulated - from_simulated_) / speed_;
    if (wall < due) return false;
    if (wall - due > 0.5) begin(simulated, wall);  // lost time is not caught up
    return true;
  }

  bool paused() const { return paused_; }
  /// Returns whether a step was asked for, and forgets it.
  bool take_step() { return std::exchange(stepping_, false); }
  double speed() const { return speed_; }
  void set_paused(bool paused) { paused_ = paused; }
  void set_speed(double speed) {
    speed_ = speed;
    has_begun_ = false;
  }
  /// Begins anew after a jump of simulated time.
  void begin_anew() { has_begun_ = false; }
  /// Lets a paused run go on to the next frame.
  void step() { stepping_ = paused_ = true; }

 private:
  void begin(double simulated, double wall) {
    from_simulated_ = simulated;
    from_wall_ = wall;
    has_begun_ = true;
  }

  double speed_;
  bool paused_, stepping_ = false, has_begun_ = false;
  double from_simulated_ = 0, from_wall_ = 0;
};

}  // namespace muro::view
