// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace muro::watch {

/// Finds robots that stand too deep in the body that carries them. Contacts that are too soft for their load let a
/// robot sink in and stay there. This is no failure, but rigid bodies do not do it.
class RestingDepth {
 public:
  /// Never finds a robot too deep.
  RestingDepth() = default;
  /// `size`: m, from the robot's base to its farthest point.
  explicit RestingDepth(double size) : most_(std::max(least, relative * size)) {}

  /// Starts anew: earlier depths belong to another run or another motion.
  void begin() { since_ = never; }
  /// Takes the depth (m) of the deepest contact at `time` (s). Returns whether it has been too deep for half a second.
  bool sees(double time, double depth) {
    if (!(depth > most_) || time < since_) since_ = time;
    return time - since_ >= lasting;
  }

 private:
  static constexpr double least = 1e-3;     ///< m
  static constexpr double relative = 2e-3;  ///< part of its size
  static constexpr double lasting = 0.5;    ///< s: an impact is over sooner

  static constexpr double never = std::numeric_limits<double>::infinity();

  double most_ = never;
  double since_ = never;
};

}  // namespace muro::watch
