// SPDX-License-Identifier: MIT
#include "springs.hpp"

#include <algorithm>
#include <cmath>

namespace walking {
namespace {

constexpr double smoothing = 0.1;  // s, time constant of the share

}  // namespace

/// Counts half of the sag as all of it, since dry friction carries a part.
void Springs::feel_at_rest(const BothLegs& sag, const BothLegs& behind, double h) {
  double along = 0, all = 0;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t j = 0; j < leg_joints; ++j) {
      along += sag[side][j] * behind[side][j];
      all += sag[side][j] * sag[side][j];
    }
  if (all == 0) return;
  share_ += h / smoothing * ((along > 0.5 * all ? 1 : 0) - share_);
  gives_way_ = share_ > 0.5;
  given_ = double(gives_way_);
}

/// Leaves out the ankles, which feedback turns. Joints that meet their targets are found soon, before feedback does
/// harm; springs come back smoothly.
void Springs::feel(const BothLegs& sag, const BothLegs& behind, const Reference& now, double h) {
  constexpr double meets = 0.04;   // share of the largest sag: a joint that is less behind meets its target
  constexpr double soon = 0.02;    // s, for which all joints meet their targets
  constexpr double memory = 0.05;  // s, time constant of `given_`
  double along = 0, all = 0, largest_sag = 0, largest_behind = 0;
  for (const Side side : {left_side, right_side}) {
    if (!now.carries(side)) continue;
    for (std::size_t j = hip_yaw; j <= knee; ++j) {
      along += sag[side][j] * behind[side][j];
      all += sag[side][j] * sag[side][j];
      largest_sag = std::max(largest_sag, std::abs(sag[side][j]));
      largest_behind = std::max(largest_behind, std::abs(behind[side][j]));
    }
  }
  if (all == 0) return;
  met_ = largest_behind < meets * largest_sag ? met_ + h : 0;
  given_ += h / (memory + h) * (std::clamp(along / all, -1.0, 1.0) - given_);
  if (gives_way_ && met_ > soon) {
    gives_way_ = 0;
    share_ = given_ = 0;
  } else if (!gives_way_ && given_ > 0.5) {
    gives_way_ = 1;
  }
  if (gives_way_) share_ += std::min(1.0, h / smoothing) * (1 - share_);
}

}  // namespace walking
