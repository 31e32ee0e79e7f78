// SPDX-License-Identifier: MIT
#include "tests/bench/baselines/scanners.hpp"
#include "muro/toolkit/rotations.hpp"

#include <cmath>

namespace muro::bench {

Pattern::Pattern(int columns_, int rows_) : columns(columns_), rows(rows_), full_circle(columns_ >= 1024) {
  constexpr double degree = M_PI / 180;
  horizontal_fov = (full_circle ? 360 : 240) * degree;
  vertical_fov = rows == 1 ? 0 : (full_circle ? 45 : 30) * degree;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double azimuth = horizontal_fov * (double(c) / (full_circle ? columns : columns - 1) - 0.5);
      const double elevation = rows == 1 ? 0 : vertical_fov * (double(r) / (rows - 1) - 0.5);
      x.push_back(float(std::cos(elevation) * std::cos(azimuth)));
      y.push_back(float(std::cos(elevation) * std::sin(azimuth)));
      z.push_back(float(std::sin(elevation)));
    }
}

void drive(const City& city, double t, std::vector<Pose>& poses) {
  poses.resize(city.starts().size());
  for (std::size_t v = 0; v < poses.size(); ++v) {
    const Pose& start = city.starts()[v];
    const double along = 1.5 * std::sin(0.7 * t + double(v)), turn = 0.3 * std::sin(0.5 * t + double(v));
    poses[v] = start * Pose{{along, 0, 0}, from_rpy(0, 0, turn)};
  }
}

}  // namespace muro::bench
