// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "error_chain.hpp"
#include "muro/handles.hpp"
#include "plugins/sensor/common/neighbours/neighbour.hpp"

namespace muro {

/// The reading of neighbours: distance, bearing, elevation and heading are the components of the chain.
class NeighbourErrors {
 public:
  NeighbourErrors() = default;
  NeighbourErrors(ListIn<neighbours::Neighbour> truth, ListOut<neighbours::Neighbour> measured)
      : truth_(truth), measured_(measured) {}

  explicit operator bool() const { return bool(truth_); }

  /// `keys`: keys of the names of all robots, by number of the robot.
  void apply(const ErrorChain& chain, std::span<double> state, const ErrorChain::Sample& sample,
             std::span<const std::uint64_t> keys) const {
    chain.begin_sample(state, sample);
    measured_.clear();
    for (const neighbours::Neighbour& n : *truth_) {
      double read[] = {n.distance, n.bearing, n.elevation, n.heading};
      const bool is_robot = n.id >= 0 && n.id < double(keys.size());
      if (!chain.apply_to_one(read, state, sample, is_robot ? keys[std::size_t(n.id)] : 0)) continue;
      measured_.push_back({n.id, std::max(0.0, read[0]), wrapped(read[1]),
                           std::clamp(read[2], -0.5 * std::numbers::pi, 0.5 * std::numbers::pi), wrapped(read[3])});
    }
    const std::span<neighbours::Neighbour> all = *measured_;
    std::sort(all.begin(), all.end(), neighbours::is_listed_before);
  }

 private:
  static double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

  ListIn<neighbours::Neighbour> truth_;
  ListOut<neighbours::Neighbour> measured_;
};

}  // namespace muro
