// SPDX-License-Identifier: MIT
// The poses of robots, their links and joints in a run, and their deviation from those in another run.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

/// Poses of some robots over time. All runs of a comparison are sampled at the same instants.
class Trajectory {
 public:
  struct Sample {
    Vec3 position = Vec3::Zero();  ///< m, position of the base in the world
    double heading = 0;            ///< rad
  };

  /// `robots`: numbers of the robots to record.
  explicit Trajectory(std::vector<std::uint32_t> robots) : robots_(std::move(robots)) {}
  void sample(const Simulation& simulation);
  /// Sum of the straight distances between samples, mean over the robots, m.
  double distance() const;
  const std::vector<std::uint32_t>& robots() const { return robots_; }

 private:
  friend struct Deviation deviation_of(const Trajectory& trajectory, const Trajectory& reference);
  void sample_links(const World& world, const RobotView& robot);

  std::vector<std::uint32_t> robots_;
  std::vector<Sample> samples_;           ///< by instant, and in each instant by robot
  std::vector<Vec3> links_;               ///< m, world: origins of all links except the base, in the same order
  std::vector<double> revolute_joints_;   ///< rad, in the same order
  std::vector<double> prismatic_joints_;  ///< m, in the same order
};

/// Deviation of values from those of the reference.
struct Differences {
  double rms = 0;      ///< root of the mean square
  double largest = 0;  ///< absolute
};

/// Deviation over all instants and robots.
struct Deviation {
  double position_rms = 0;      ///< root of the mean square of the distance, m
  double position_largest = 0;  ///< m
  double heading_largest = 0;   ///< rad, 0 to pi
  /// Origins of all links except the bases, m, and joints, whole turns included; empty when no robot has any.
  std::optional<Differences> links, revolute_joints, prismatic_joints;
};
/// Returns the deviation of two trajectories of the same robots at the same instants.
Deviation deviation_of(const Trajectory& trajectory, const Trajectory& reference);

}  // namespace muro::host
