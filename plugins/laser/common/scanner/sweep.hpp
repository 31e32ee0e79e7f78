// SPDX-License-Identifier: MIT
// A scan whose rays are taken one after the other, each from where the device is at that time.
#pragma once

#include "rays.hpp"

namespace muro::scanner {

/// A scan in `steps` steps of the algorithm: one revolution of the mirror. For a grid the mirror turns at constant
/// speed and counter-clockwise, from the first azimuth at the start of the scan all around; all rows of a column
/// are taken together. The rays of a list are spread evenly over the scan.
class Sweep {
 public:
  Sweep(const Grid& grid, bool is_list, std::uint32_t steps);

  std::uint32_t steps() const { return std::uint32_t(first_.size() - 1); }
  /// The columns taken between step k - 1 and step `k`: first(k) to first(k + 1) - 1.
  std::uint32_t first(std::uint32_t k) const { return first_[k]; }
  /// When a column is taken within its step: 0 at the step before, 1 at the step.
  double time_fraction(std::uint32_t column) const { return time_fractions_[column]; }
  /// The last step in which a ray is taken; the scan is complete then.
  std::uint32_t last_step() const { return last_step_; }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<double> time_fractions_;
  std::uint32_t last_step_ = 0;
};

}  // namespace muro::scanner
