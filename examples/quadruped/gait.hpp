// SPDX-License-Identifier: MIT
// The clock of a trot: diagonal pairs of legs swing in turn.
#pragma once

#include <array>
#include <cmath>

namespace quadruped {

inline constexpr int legs = 4;
/// Legs in the order that is used throughout.
enum LegName { front_left, front_right, rear_left, rear_right };

struct Gait {
  double period = 0.4;  ///< s, duration of a stride
  double duty = 0.5;    ///< share of a stride in stance; from 0.5 on at least two feet always stand
  static constexpr std::array<double, legs> offsets{0, 0.5, 0.5, 0};

  double stance_time() const { return duty * period; }
  double swing_time() const { return (1 - duty) * period; }
};

/// Place of a leg in its stride.
struct LegPhase {
  bool swings = false;
  double progress = 0;  ///< 0 to 1, of its stance or of its swing
};

/// Clock in strides. While the robot stands, the clock stands, too, and all legs are in stance.
struct GaitClock {
  double phase = 0;  ///< 0 to 1
  double runs = 0;   ///< 1: it trots

  LegPhase of(const Gait& gait, int leg) const {
    if (runs == 0) return {};
    const double at = std::fmod(phase + Gait::offsets[std::size_t(leg)], 1.0);
    if (at < gait.duty) return {false, at / gait.duty};
    return {true, (at - gait.duty) / (1 - gait.duty)};
  }
  void start(const Gait& gait) { phase = gait.duty - 0.5, runs = 1; }
  /// Advances by `dt` s. Stops when a pair of legs has come down, if it `may_stop`.
  void advance(const Gait& gait, double dt, bool may_stop) {
    if (runs == 0) return;
    const double before = phase;
    phase += dt / gait.period;
    const bool lands = std::floor(2 * before) != std::floor(2 * phase);
    phase -= std::floor(phase);
    if (lands && may_stop) runs = 0;
  }
};

}  // namespace quadruped
