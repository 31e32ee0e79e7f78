// SPDX-License-Identifier: MIT
// A scan with rays taken one after the other, each from the pose of the device at that time.
#pragma once

#include "rays.hpp"

namespace muro::scanner {

/// A scan in `steps` steps of the algorithm: one revolution of the mirror. For a grid the mirror turns at constant
/// speed and counter-clockwise through a full turn, from the first azimuth at the start of the scan. All rows of a
/// column are taken together. The rays of a list are spread evenly over the scan.
class Sweep {
 public:
  Sweep(const Grid& grid, bool is_list, std::uint32_t steps);

  std::uint32_t steps() const { return std::uint32_t(first_.size() - 1); }
  /// Returns the first column taken between step k - 1 and step `k`; the last one is first(k + 1) - 1.
  std::uint32_t first(std::uint32_t k) const { return first_[k]; }
  /// Returns the time of a column within its step: 0 at the previous step, 1 at the step.
  double time_fraction(std::uint32_t column) const { return time_fractions_[column]; }
  /// Returns the last step in which a ray is taken; the scan is complete then.
  std::uint32_t last_step() const { return last_step_; }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<double> time_fractions_;
  std::uint32_t last_step_ = 0;
};

}  // namespace muro::scanner
