// SPDX-License-Identifier: MIT
// The city of the benchmarks: laser.zbuffer compared with laser.raycast, with the rays of real scanners.
#include <algorithm>

#include "muro/toolkit/rotations.hpp"
#include "tests/bench/baselines/city.hpp"
#include "tests/conformance/laser/room.hpp"

namespace muro {
namespace {

using namespace test;

struct Errors {
  double median = 0, p99 = 0;  ///< m
  double share_of_edges = 0;
};

/// Returns the errors of a scanner 0.22 m above the ground on vehicles of a city with 100. Rays with an edge within a
/// pixel do not count: there the exact reading bends.
Errors errors_in_the_city(const Settings& settings, double spacing, double supersampling, double tilt) {
  std::vector<double> errors;
  std::size_t rays = 0;
  const bench::City city(100);
  for (const std::size_t vehicle : {0u, 17u, 42u, 77u}) {
    Room s(city.starts()[vehicle] * Pose{{0, 0, 0.13}, from_rpy(0, tilt, 0)});
    s.add_ground();
    for (std::size_t i = 0; i < city.blocks().size(); ++i)
      s.put("block" + std::to_string(i), Shape::box(city.blocks()[i].lengths),
            {city.blocks()[i].centre, Quat::Identity()});
    const RobotTree rover = s.read_model(MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf");
    for (std::size_t v = 0; v < city.starts().size(); ++v)
      if (v != vehicle) s.add("v" + std::to_string(v), rover, city.starts()[v]);
    const std::size_t tried = s.add_laser("laser.zbuffer", with(settings, {{"supersampling", supersampling}}));
    const double pixel = spacing / supersampling;
    std::vector<std::size_t> exact;
    for (const double aside : {0.0, -pixel, pixel}) {
      exact.push_back(s.add_laser("laser.raycast", with(settings, {{"rpy", std::vector<double>{0, 0, aside}}})));
      exact.push_back(s.add_laser("laser.raycast", with(settings, {{"rpy", std::vector<double>{0, aside, 0}}})));
    }
    s.build_and_run();
    const bool flat = settings.count("rows") == 0;
    const auto read = [&](std::size_t k, std::size_t i) { return 1 / s.ranges(exact[k])[i]; };
    for (std::size_t i = 0; i < s.ranges(tried).size(); ++i) {
      const double middle = read(0, i);
      const double bend = std::max(std::abs(read(2, i) - 2 * middle + read(4, i)),
                                   flat ? 0.0 : std::abs(read(3, i) - 2 * middle + read(5, i)));
      ++rays;
      if (bend < 1e-3 * middle) errors.push_back(std::abs(s.ranges(tried)[i] - 1 / middle));
    }
  }
  std::sort(errors.begin(), errors.end());
  const double n = double(errors.size());
  return {errors[std::size_t(0.5 * n)], errors[std::size_t(0.99 * n)], 1 - n / double(rays)};
}

TEST(TheZBufferInTheCity, ReadsAsRaysDoWithTheUrg) {
  const Errors e = errors_in_the_city(urg(), 2 * pi / 1024, 4, 0);
  EXPECT_LT(e.median, 1e-5) << "m; wanted: 1e-3";
  EXPECT_LT(e.p99, 1e-3) << "wanted: 1e-2";
  EXPECT_LT(e.share_of_edges, 0.1);
  RecordProperty("median_mm", std::to_string(1e3 * e.median));
  RecordProperty("p99_mm", std::to_string(1e3 * e.p99));
}

TEST(TheZBufferInTheCity, ReadsAsRaysDoWithAHundredByAHundred) {
  const Errors e = errors_in_the_city(grid_100(), pi / 3 / 99, 4, 0.2);
  EXPECT_LT(e.median, 1e-5) << "m; wanted: 1e-3";
  EXPECT_LT(e.p99, 1e-3) << "wanted: 1e-2";
  EXPECT_LT(e.share_of_edges, 0.1);
  RecordProperty("median_mm", std::to_string(1e3 * e.median));
  RecordProperty("p99_mm", std::to_string(1e3 * e.p99));
}

}  // namespace
}  // namespace muro
