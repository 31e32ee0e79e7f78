// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace muro::watch {

/// How deep a robot stands in what carries it. Contacts that are too soft for what they bear let it sink and stay
/// there: no failure, but not what rigid bodies do.
class RestingDepth {
 public:
  /// Finds nothing too deep.
  RestingDepth() = default;
  /// `size`: m, from its base to its farthest point.
  explicit RestingDepth(double size) : most_(std::max(least, relative * size)) {}

  /// What it has seen was another run, or another motion's work.
  void begin() { since_ = never; }
  /// Its deepest contact is `depth` (m) deep at `time` (s). Whether it has been too deep for half a second.
  bool sees(double time, double depth) {
    if (!(depth > most_) || time < since_) since_ = time;
    return time - since_ >= lasting;
  }

 private:
  static constexpr double least = 1e-3;     ///< m
  static constexpr double relative = 2e-3;  ///< of its size
  static constexpr double lasting = 0.5;    ///< s: an impact is over sooner

  static constexpr double never = std::numeric_limits<double>::infinity();

  double most_ = never;
  double since_ = never;
};

}  // namespace muro::watch
