// SPDX-License-Identifier: MIT
// The poses of robots, their links and joints in a run, and their deviation from those in another run.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

/// Some robots over time. All runs of a comparison are sampled at the same instants.
class Trajectory {
 public:
  struct Sample {
    Vec3 position = Vec3::Zero();  ///< of the base, m, world
    double heading = 0;            ///< rad
  };

  /// `robots`: numbers of those that are recorded.
  explicit Trajectory(std::vector<std::uint32_t> robots) : robots_(std::move(robots)) {}
  void sample(const Simulation& simulation);
  /// The sum of the straight distances between samples, mean over the robots, m.
  double distance() const;
  const std::vector<std::uint32_t>& robots() const { return robots_; }

 private:
  friend struct Deviation deviation_of(const Trajectory& trajectory, const Trajectory& reference);
  void sample_links(const World& world, const RobotView& robot);

  std::vector<std::uint32_t> robots_;
  std::vector<Sample> samples_;           ///< instant by instant, in each robot by robot
  std::vector<Vec3> links_;               ///< m, world: origins of all links but the base, in the same order
  std::vector<double> revolute_joints_;   ///< rad, likewise
  std::vector<double> prismatic_joints_;  ///< m, likewise
};

/// How far some values are from those of the reference.
struct Differences {
  double rms = 0;      ///< root of the mean square
  double largest = 0;  ///< absolute
};

/// Over all instants and robots.
struct Deviation {
  double position_rms = 0;      ///< root of the mean square of the distance, m
  double position_largest = 0;  ///< m
  double heading_largest = 0;   ///< rad, 0 to pi
  /// Of the origins of all links but the bases, m, and of joints, whole turns included; none where no robot has any.
  std::optional<Differences> links, revolute_joints, prismatic_joints;
};
/// Of two trajectories of the same robots at the same instants.
Deviation deviation_of(const Trajectory& trajectory, const Trajectory& reference);

}  // namespace muro::host
