// SPDX-License-Identifier: MIT
// Decides which feet stand and which swing: by the clock, and by their contacts.
#pragma once

#include <algorithm>
#include <array>

#include "../common/vector.hpp"
#include "gait.hpp"
#include "sensed.hpp"

namespace quadruped {

/// State of a leg, kept from step to step.
struct LegState {
  double swings = 0;   ///< 1: by the clock it is in the air
  double touched = 1;  ///< 1: it has found the ground since it was lifted, and pushes
  double stood = 0;    ///< s: time since it found the ground
  Vector lifted_at;    ///< m: place of its foot when it was lifted, seen from the body, level
};

struct Stride {
  std::array<LegState, legs> leg;

  void begin(const Sensed& seen) {
    for (std::size_t i = 0; i < legs; ++i) leg[i].touched = !seen.feels || seen.touches[i];
  }
  /// Updates the legs. A foot that touches early, in the second half of its swing, stands from then on. A foot that
  /// should stand and finds no ground does not. Feet without sensors stand by the clock.
  void advance(const Gait& gait, const GaitClock& clock, const Sensed& seen, double dt) {
    for (int i = 0; i < legs; ++i) {
      LegState& l = leg[std::size_t(i)];
      const LegPhase phase = clock.of(gait, i);
      if (phase.swings && l.swings == 0) l.touched = 0, l.lifted_at = seen.feet[std::size_t(i)].position;
      l.swings = phase.swings;
      const bool may_touch = !phase.swings || phase.progress > landing;
      if (!seen.feels)
        l.touched = !phase.swings;
      else if (seen.touches[std::size_t(i)] && may_touch)
        l.touched = 1;
      l.stood = l.touched != 0 ? l.stood + dt : 0;
    }
  }
  std::array<bool, legs> stands() const {
    std::array<bool, legs> all{};
    for (std::size_t i = 0; i < legs; ++i) all[i] = leg[i].touched != 0;
    return all;
  }
  /// Returns how firmly each foot stands, 0 to 1: feet come to rest within a while.
  std::array<double, legs> believed() const {
    std::array<double, legs> all{};
    for (std::size_t i = 0; i < legs; ++i) all[i] = std::min(1.0, leg[i].stood / comes_to_rest);
    return all;
  }

 private:
  static constexpr double landing = 0.5;         // share of a swing after which it may touch
  static constexpr double comes_to_rest = 0.03;  // s
};

}  // namespace quadruped
