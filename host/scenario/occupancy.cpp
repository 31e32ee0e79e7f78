// SPDX-License-Identifier: MIT
#include "host/scenario/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace muro::host {

namespace {

bool overlaps(const Footprint& f, const Obstacle& o, double clearance) {
  const Vec3 p = o.pose.inverse() * Vec3(f.x, f.y, o.pose.position.z());
  const double dx = std::max(0.0, std::abs(p.x()) - o.half_x), dy = std::max(0.0, std::abs(p.y()) - o.half_y);
  return std::sqrt(dx * dx + dy * dy) < f.radius + clearance;
}

bool overlaps(const Footprint& a, const Footprint& b, double clearance) {
  const double dx = a.x - b.x, dy = a.y - b.y;
  return std::sqrt(dx * dx + dy * dy) < a.radius + b.radius + clearance;
}

/// Returns the cell of a coordinate. Monotone, also for coordinates without a cell of their own.
std::int64_t cell_of(double x, double cell) { return std::int64_t(std::floor(std::clamp(x / cell, -1e18, 1e18))); }

}  // namespace

void Occupancy::add(const Footprint& footprint) { add(footprint, footprint.x, footprint.y, footprint.radius); }

void Occupancy::add(const Obstacle& obstacle) {
  const Vec3& p = obstacle.pose.position;
  // A tilted rectangle has no such circle, because its plane is met far away: see overlaps().
  const bool is_upright = (obstacle.pose.orientation * Vec3::UnitZ()).z() > 1 - 1e-12;
  const double circle = std::sqrt(obstacle.half_x * obstacle.half_x + obstacle.half_y * obstacle.half_y);
  add(obstacle, p.x(), p.y(), is_upright ? 1.001 * circle : std::numeric_limits<double>::infinity());
}

void Occupancy::add(const Item& item, double x, double y, double radius) {
  constexpr double smallest = 1e-6, largest = 1e6;
  if (!(radius <= largest) || !std::isfinite(x) || !std::isfinite(y)) return large_.push_back(item);
  const int exponent = std::ilogb(2 * std::max(radius, smallest)) + 1;
  Level& level = levels_.try_emplace(exponent, Level{std::ldexp(1.0, exponent), {}, {}}).first->second;
  level.cells[{cell_of(x, level.cell), cell_of(y, level.cell)}].push_back(std::uint32_t(level.items.size()));
  level.items.push_back(item);
}

bool Occupancy::is_free(const Footprint& f, double clearance) const {
  const auto meets = [&](const Item& item) {
    return std::visit([&](const auto& other) { return overlaps(f, other, clearance); }, item);
  };
  if (std::any_of(large_.begin(), large_.end(), meets)) return false;
  for (const auto& of_size : levels_) {
    const Level& level = of_size.second;
    const double reach = f.radius + clearance + 0.51 * level.cell;  // an item extends half a cell from its centre
    const Cell low{cell_of(f.x - reach, level.cell), cell_of(f.y - reach, level.cell)},
        high{cell_of(f.x + reach, level.cell), cell_of(f.y + reach, level.cell)};
    const double cells = (double(high.x) - double(low.x) + 1) * (double(high.y) - double(low.y) + 1);
    if (cells > double(level.items.size())) {
      if (std::any_of(level.items.begin(), level.items.end(), meets)) return false;
      continue;
    }
    for (std::int64_t x = low.x; x <= high.x; ++x)
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        const auto cell = level.cells.find({x, y});
        if (cell == level.cells.end()) continue;
        const auto& items = cell->second;
        if (std::any_of(items.begin(), items.end(), [&](std::uint32_t i) { return meets(level.items[i]); }))
          return false;
      }
  }
  return true;
}

}  // namespace muro::host
