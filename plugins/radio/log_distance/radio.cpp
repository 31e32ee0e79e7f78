// SPDX-License-Identifier: MIT
#include "radio.hpp"

#include <algorithm>
#include <cmath>

namespace muro::log_distance {

std::optional<double> Channel::received_power(std::uint64_t seed, const Radio& a, const Vec3& from, const Radio& b,
                                              const Vec3& to, std::int64_t number, double least) const {
  const double distance = (to - from).norm();
  if (!(distance <= max_range)) return std::nullopt;
  double power = a.parameters.tx_power - path_loss.at(distance);
  if (shadowing_sigma > 0) {
    const std::int64_t drawn_for = shadowing == Shadowing::link ? -1 : number;
    power -= shadowing_sigma * random(seed, a, b, drawn_for).normal(0);
  }
  if (power < least) return std::nullopt;
  if (obstacles == Obstacles::ignore) return power;
  if (obstacles == Obstacles::block)
    return sight->is_clear(from, to, a.robot, b.robot) ? std::optional(power) : std::nullopt;
  if (obstacle_loss == 0) return power;
  const double bearable = std::min((power - least) / obstacle_loss, 1e6);
  power -= obstacle_loss * sight->obstacles(from, to, a.robot, b.robot, std::uint32_t(bearable) + 1);
  return power < least ? std::nullopt : std::optional(power);
}

}  // namespace muro::log_distance
