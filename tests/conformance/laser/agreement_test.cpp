// SPDX-License-Identifier: MIT
// Laser methods compared with each other, in scenes without a closed form. laser.raycast is exact and shows what the
// others may read: its own distance, or, at an edge within their blur, a distance from the other side of the edge.
#include <algorithm>

#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/laser/room.hpp"

namespace muro {
namespace {

using namespace test;

class EveryOtherLaser : public testing::TestWithParam<std::string> {};

std::vector<std::string> others() {
  std::vector<std::string> ids = laser_methods();
  std::erase(ids, "laser.raycast");
  return ids;
}
INSTANTIATE_TEST_SUITE_P(Conformance, EveryOtherLaser, testing::ValuesIn(others()), method_name);

constexpr double places[] = {-1.5, -0.75, 0, 0.75, 1.5};  ///< offsets around a ray, in pixels

/// Returns the directions of a grid, each with those around it at `places`; `pixel`: size of a pixel, rad.
std::vector<double> with_neighbours(const Settings& grid, double pixel) {
  const auto number = [&](const char* name, double otherwise) {
    const auto found = grid.find(name);
    if (found == grid.end()) return otherwise;
    if (const auto* i = std::get_if<std::int64_t>(&found->second)) return double(*i);
    return std::get<double>(found->second);
  };
  const int columns = int(number("rays", 360)), rows = int(number("rows", 1));
  const double left = number("min_angle", -pi), right = number("max_angle", pi);
  const double low = number("min_elevation", 0), high = number("max_elevation", 0);
  std::vector<double> list;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double a = left + column * (right - left) / (columns - 1);
      const double e = rows > 1 ? low + row * (high - low) / (rows - 1) : low;
      for (const double up : places)
        for (const double aside : places)
          list.insert(list.end(), {a + aside * pixel / std::max(std::cos(e), 0.1), rows > 1 ? e + up * pixel : e});
    }
  return list;
}

struct Difference {
  double median = 0;    ///< m
  double worst = 0;     ///< m, beyond the allowed error, where there is no step within a pixel and a half
  double invented = 0;  ///< fraction of readings that lie on neither side of a step
  double outside = 0;   ///< fraction of readings nearer or farther than all surfaces there
  double off = 0;       ///< fraction of readings that differ by more than a centimetre
};

Difference compare(Room& s, std::size_t tried, std::size_t exact, const Bound& bound) {
  Difference d;
  constexpr std::size_t around = std::size(places) * std::size(places);
  const std::span<double> read = s.ranges(tried), there = s.ranges(exact);
  const double one = 1 / double(read.size());
  std::vector<double> errors;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const double* r = &there[around * i];
    const double middle = r[around / 2], error = std::abs(read[i] - middle);
    double low = middle, high = middle, nearest = error;
    for (std::size_t k = 0; k < around; ++k) {
      low = std::min(low, r[k]);
      high = std::max(high, r[k]);
      nearest = std::min(nearest, std::abs(read[i] - r[k]));
    }
    const double allowed = bound.absolute + bound.relative * middle;
    const bool smooth = high - low < 0.05 * middle;
    // between pixels a method reads the chord of a curve
    const auto bend = [&](std::size_t a, std::size_t b) { return std::abs(1 / r[a] - 2 / middle + 1 / r[b]); };
    const double curved = bound.blur > 0 ? middle * middle * std::max(bend(10, 14), bend(2, 22)) : 0;
    if (smooth) d.worst = std::max(d.worst, error - allowed - curved);
    if (!smooth && nearest > allowed + 0.03 * middle) d.invented += one;
    if (read[i] < low - allowed - 0.01 * low || read[i] > high + allowed + 0.01 * high) d.outside += one;
    if (error > 0.01) d.off += one;
    errors.push_back(error);
  }
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
  d.median = errors[errors.size() / 2];
  return d;
}

/// Rays of a scan, and the angle (rad) between neighbours.
struct ScanPattern {
  Settings grid;
  double spacing;
};
std::vector<ScanPattern> scan_patterns() {
  const auto grid = [](int columns, int rows, double wide, double high) {
    return Settings{{"rays", std::int64_t(columns)}, {"rows", std::int64_t(rows)},   {"min_angle", -0.5 * wide},
                    {"max_angle", 0.5 * wide},       {"min_elevation", -0.5 * high}, {"max_elevation", 0.5 * high}};
  };
  return {{with(urg(), {{"max_range", 20.0}}), 2 * pi / 1024},
          {grid(100, 100, pi / 3, pi / 3), pi / 3 / 99},
          {grid(200, 24, 1.5 * pi, 0.8), 0.8 / 23},
          {grid(90, 40, 6.2, 3.0), 6.2 / 89}};
}

Difference difference_from_rays(const std::string& method, const ScanPattern& pattern, unsigned seed,
                                double supersampling) {
  Room s({{0, 0, 1}, from_rpy(0.05, -0.04, 0.3 * seed)});
  s.add_ground();
  s.scatter(seed, 60);
  const Bound bound = bound_of(method, pattern.spacing, supersampling);
  Settings settings = pattern.grid;
  if (method == "laser.zbuffer") settings["supersampling"] = supersampling;
  const std::size_t tried = s.add_laser(method, settings);
  const std::size_t exact =
      s.add_laser("laser.raycast", {{"directions", with_neighbours(pattern.grid, bound.blur)}, {"min_range", 0.02}});
  s.build_and_run();
  return compare(s, tried, exact, bound);
}

TEST_P(EveryOtherLaser, AgreesWithRaysOnSceneryAndRobotsOfAllShapes) {
  const bool exact = bound_of(GetParam(), 1, 1).blur == 0;
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const ScanPattern& pattern : scan_patterns()) {
      const Difference d = difference_from_rays(GetParam(), pattern, seed, 1);
      EXPECT_LE(d.worst, 0) << "seed " << seed;
      EXPECT_LE(d.invented, exact ? 0 : 0.01);
      EXPECT_LE(d.outside, exact ? 0 : 0.002);
      EXPECT_LE(d.off, exact ? 0 : 0.07) << "rays near edges";
      EXPECT_LE(d.median, exact ? 1e-9 : 1e-4);
    }
}

TEST(TheZBuffer, ComesNearerToRaysWithSupersampling) {
  for (const ScanPattern& pattern : scan_patterns()) {
    const double once = difference_from_rays("laser.zbuffer", pattern, 5, 1).off,
                 four_times = difference_from_rays("laser.zbuffer", pattern, 5, 4).off;
    EXPECT_GT(once, 0);
    EXPECT_LT(four_times, 0.45 * once) << "rays near edges are fewer";
  }
}

TEST_P(EveryOtherLaser, SeesTheSameObjectsAsRays) {
  Room s({{0, 0, 1}, from_rpy(0.05, -0.04, 1)});
  s.add_ground();
  s.scatter(9, 60);
  const Settings grid = with(grid_100(), {{"hits", true}});
  const std::size_t tried = s.add_laser(GetParam(), grid), exact = s.add_laser("laser.raycast", grid);
  s.build_and_run();
  int differ = 0;
  for (std::size_t i = 0; i < 10000; ++i) differ += s.hits(tried)[i] != s.hits(exact)[i];
  EXPECT_LT(differ, bound_of(GetParam(), 1, 1).blur > 0 ? 400 : 1) << "of 10 000; only at edges";
}

}  // namespace
}  // namespace muro
