// SPDX-License-Identifier: MIT
// What robots did in a run, and how far that is from what they did in another.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

/// Where some robots were. All runs of a comparison are looked at in the same instants.
class Track {
 public:
  struct Spot {
    Vec3 position = Vec3::Zero();  ///< of the base, m, world
    double heading = 0;            ///< rad
  };

  /// `robots`: numbers of those that are watched.
  explicit Track(std::vector<std::uint32_t> robots) : robots_(std::move(robots)) {}
  void look(const Simulation& simulation);
  /// The straight way between looks, mean over the robots, m.
  double distance() const;
  const std::vector<std::uint32_t>& robots() const { return robots_; }

 private:
  friend struct Deviation deviation_of(const Track& track, const Track& reference);
  std::vector<std::uint32_t> robots_;
  std::vector<Spot> spots_;  ///< look by look, in each robot by robot
};

/// Over all instants and robots.
struct Deviation {
  double position_rms = 0;      ///< root of the mean square of the distance, m
  double position_largest = 0;  ///< m
  double heading_largest = 0;   ///< rad, 0 to pi
};
/// Of two tracks with the same robots and looks.
Deviation deviation_of(const Track& track, const Track& reference);

}  // namespace muro::host
