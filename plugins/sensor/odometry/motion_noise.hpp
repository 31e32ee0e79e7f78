// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "muro/base/random.hpp"
#include "plugins/common/wheels/planar_motion.hpp"

namespace muro::odometry {

using wheels::PlanarTwist;

/// Noise of the motion of the base between two readings. The errors depend on way and turn as in the odometry motion
/// model of Thrun, Burgard and Fox (Probabilistic Robotics, section 5.4). Its alphas are those of a way of 1 m or a
/// turn of 1 rad. Variances grow in proportion to way and turn (Siegwart, Nourbakhsh and Scaramuzza, section 5.2.4), so
/// that they do not depend on the rate.
class MotionNoise {
 public:
  MotionNoise() = default;
  MotionNoise(std::span<const double> alphas, bool slips_sideways) : slips_sideways_(slips_sideways) {
    std::copy(alphas.begin(), alphas.end(), alphas_.begin());
    is_active_ = std::any_of(alphas.begin(), alphas.end(), [](double a) { return a > 0; });
  }
  /// `moved`: m, m, rad.
  PlanarTwist operator()(PlanarTwist moved, const Random& random) const {
    if (!is_active_) return moved;
    const double way = std::sqrt(moved.x * moved.x + moved.y * moved.y), turn = std::abs(moved.yaw_rate);
    const double of_way = std::sqrt(alphas_[2] * way + alphas_[3] * turn);
    const auto [along, about] = random.normal_pair(0);
    moved.x += of_way * along;
    if (slips_sideways_) moved.y += of_way * random.normal(1);
    moved.yaw_rate += std::sqrt(alphas_[0] * turn + alphas_[1] * way) * about;
    return moved;
  }

 private:
  std::array<double, 4> alphas_{};
  bool slips_sideways_ = false, is_active_ = false;
};

}  // namespace muro::odometry
