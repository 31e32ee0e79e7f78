// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

const Pose& base_pose(const Simulation& simulation, const RobotView& robot);

/// Measures the distances that robots travel, from outside of the simulation and without influence on it.
class Odometer {
 public:
  explicit Odometer(const Simulation& simulation);
  /// Adds the straight distance since the last sample to every robot's distance, unless poses have jumped meanwhile.
  void sample();
  /// Throws StepError when a robot's pose is not finite.
  void check() const;
  double distance(std::uint32_t robot) const { return distances_[robot]; }  ///< m

  static constexpr std::int64_t period = 100'000'000;  ///< ns between samples

 private:
  const Simulation& simulation_;
  std::vector<Vec3> last_;
  std::vector<double> distances_;
  std::uint64_t jumps_ = 0;
};

}  // namespace muro::host
