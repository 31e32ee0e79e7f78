// SPDX-License-Identifier: MIT
// A scan that takes its time: its rays one after the other, from where the device then is.
#pragma once

#include "rays.hpp"

namespace muro::scanner {

/// A scan in `steps` steps of the algorithm, a turn of the mirror. A grid turns evenly and counter-clockwise, from its
/// first azimuth at the scan's start all the way round; all rows of a column are taken together. The rays of a list are
/// spread evenly over the scan.
class Sweep {
 public:
  Sweep(const Grid& grid, bool is_list, std::uint32_t steps);

  std::uint32_t steps() const { return std::uint32_t(first_.size() - 1); }
  /// Columns that are taken between step `k` and the one before: from first(k) to first(k + 1) - 1.
  std::uint32_t first(std::uint32_t k) const { return first_[k]; }
  /// When in its step a column is taken: 0 at the step before, 1 at the step.
  double moment(std::uint32_t column) const { return moments_[column]; }
  /// The last step in which a ray is taken; the scan is then complete.
  std::uint32_t last_step() const { return last_step_; }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<double> moments_;
  std::uint32_t last_step_ = 0;
};

/// The pose at `share` (0..1) of the way from `a` to `b` by the screw that joins them: what a body with a constant
/// twist in its own axes does. They differ by less than half a turn.
Pose between(const Pose& a, const Pose& b, double share);

}  // namespace muro::scanner
