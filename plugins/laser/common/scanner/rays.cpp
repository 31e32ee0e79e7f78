// SPDX-License-Identifier: MIT
#include "rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "muro/base/elementary.hpp"

namespace muro::scanner {

Vec3 direction_of(double azimuth, double elevation) {
  const auto [up, level] = elementary::sincos(elevation);
  const auto [left, ahead] = elementary::sincos(azimuth);
  return {level * ahead, level * left, up};
}

bool Grid::full_circle() const { return columns > 1 && std::abs(max_angle - min_angle - 2 * std::numbers::pi) < 1e-9; }

double Grid::first_angle() const { return columns > 1 ? min_angle : 0.5 * (min_angle + max_angle); }

double Grid::angle_increment() const {
  if (columns == 1) return 0;
  return (max_angle - min_angle) / (full_circle() ? columns : columns - 1);
}

double Grid::azimuth(std::uint32_t column) const {
  const bool last = column > 0 && column == columns - 1 && !full_circle();
  return last ? max_angle : first_angle() + column * angle_increment();
}

double Grid::elevation(std::uint32_t row) const {
  if (rows == 1) return 0.5 * (min_elevation + max_elevation);
  const double share = double(row) / (rows - 1);
  return (1 - share) * min_elevation + share * max_elevation;
}

RaySet RaySet::of(const Grid& grid) {
  RaySet set;
  set.columns = grid.columns;
  set.rows = grid.rows;
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column)
      set.directions.push_back(direction_of(grid.azimuth(column), grid.elevation(row)));
  const double across = grid.angle_increment();
  const double up = grid.rows > 1 ? (grid.max_elevation - grid.min_elevation) / (grid.rows - 1) : 0;
  set.spacing = across > 0 && up > 0 ? std::min(across, up) : std::max(across, up);
  return set;
}

RaySet RaySet::of(std::span<const double> pairs) {
  RaySet set;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) set.directions.push_back(direction_of(pairs[i], pairs[i + 1]));
  set.columns = set.size();
  std::vector<double> angles;
  for (std::size_t i = 1; i < set.directions.size(); ++i) {
    const Vec3 &a = set.directions[i - 1], &b = set.directions[i];
    const double angle = elementary::atan2(a.cross(b).norm(), a.dot(b));
    if (angle > 1e-9) angles.push_back(angle);
  }
  if (angles.empty()) return set;
  const auto middle = angles.begin() + std::ptrdiff_t(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  set.spacing = *middle;
  return set;
}

}  // namespace muro::scanner
