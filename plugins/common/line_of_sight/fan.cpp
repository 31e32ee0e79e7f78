// SPDX-License-Identifier: MIT
#include "fan.hpp"

#include <algorithm>
#include <cmath>

namespace muro::line_of_sight {

double Fan::diamond_angle(double x, double y) {
  const double length = std::abs(x) + std::abs(y);
  if (!(length > 0)) return 0;
  const double part = y / length;
  return x >= 0 ? part : y >= 0 ? 2 - part : -2 - part;
}

std::size_t Fan::sector_of(const Vec3& direction) {
  const double angle = diamond_angle(direction.x(), direction.y());
  return std::size_t(std::clamp(int((angle + 2) * (0.25 * sectors)), 0, sectors - 1));
}

void Fan::begin(const Vec3& centre, RobotId own) {
  centre_ = centre;
  own_ = own;
  usable_ = true;
  boxes_.clear();
  boxes_.reserve(most_boxes);
}

void Fan::close() {
  if (!usable_) return;
  words_ = (boxes_.size() + 63) / 64;
  std::fill_n(seen_.begin(), sectors * words_, 0);
  for (std::size_t i = 0; i < boxes_.size(); ++i) mark(i);
}

/// Marks the directions of a box. A box that does not hold the centre is seen between two of its corners, from `right`
/// counter-clockwise to `left`. They are marked a little farther apart, so that rounding does not matter.
void Fan::mark(std::size_t box) {
  const Vec3 low = boxes_[box].box.low - centre_, high = boxes_[box].box.high - centre_;
  const std::uint64_t bit = std::uint64_t(1) << (box % 64);
  std::uint64_t* const at = &seen_[box / 64];
  const int x_side = low.x() > 0 ? 1 : high.x() < 0 ? -1 : 0, y_side = low.y() > 0 ? 1 : high.y() < 0 ? -1 : 0;
  if (x_side == 0 && y_side == 0) {
    for (int k = 0; k < sectors; ++k) at[std::size_t(k) * words_] |= bit;
    return;
  }
  const double x_facing = x_side > 0 ? low.x() : high.x(), y_facing = y_side > 0 ? low.y() : high.y();
  const double right = diamond_angle(y_side > 0   ? high.x()
                                     : y_side < 0 ? low.x()
                                                  : x_facing,
                                     x_side > 0   ? low.y()
                                     : x_side < 0 ? high.y()
                                                  : y_facing);
  const double left = diamond_angle(y_side > 0   ? low.x()
                                    : y_side < 0 ? high.x()
                                                 : x_facing,
                                    x_side > 0   ? high.y()
                                    : x_side < 0 ? low.y()
                                                 : y_facing);
  constexpr double rounding = 1e-9, turn = 4, per_angle = sectors / turn;
  const int first = int((right - rounding + 1.5 * turn) * per_angle),
            last = int((left + rounding + (left < right ? 2.5 : 1.5) * turn) * per_angle);
  for (int k = first; k <= last; ++k) at[std::size_t(k % sectors) * words_] |= bit;
}

}  // namespace muro::line_of_sight
