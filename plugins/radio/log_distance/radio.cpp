// SPDX-License-Identifier: MIT
#include "radio.hpp"

#include <algorithm>
#include <cmath>

namespace muro::log_distance {

std::optional<double> Channel::unobstructed_power(std::uint64_t seed, const Radio& a, const Vec3& from, const Radio& b,
                                                  const Vec3& to, std::int64_t number) const {
  const double distance = (to - from).norm();
  if (!(distance <= max_range)) return std::nullopt;
  const double power = a.parameters.tx_power - path_loss.at(distance);
  if (shadowing_sigma == 0) return power;
  const std::int64_t drawn_for = shadowing == Shadowing::link ? -1 : number;
  return power - shadowing_sigma * random(seed, a, b, drawn_for).normal(0);
}

std::uint32_t Channel::deciding_obstacles(double margin) const {
  switch (obstacles) {
    case Obstacles::ignore:
      return 0;
    case Obstacles::block:
      return 1;
    default:
      return obstacle_loss > 0 ? std::uint32_t(std::min(margin / obstacle_loss, 1e6)) + 1 : 0;
  }
}

std::optional<double> Channel::behind(std::uint32_t count, double power, double least) const {
  if (count == 0) return power;
  if (obstacles == Obstacles::block) return std::nullopt;
  power -= obstacle_loss * count;
  return power < least ? std::nullopt : std::optional(power);
}

}  // namespace muro::log_distance
