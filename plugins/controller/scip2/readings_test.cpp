// SPDX-License-Identifier: MIT
// Conversion of rays of a laser to readings of steps.
#include "readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace muro::scip2 {
namespace {

constexpr double pi = std::numbers::pi;

RayGrid grid_of(const Model& m) { return {m.angle_of(m.first_step), 2 * pi / m.steps_per_turn, m.step_count(), 0}; }

struct Scan {
  std::vector<std::uint32_t> distances, intensities;
};

Scan read(const Model& m, const RayGrid& grid, const LaserScan& scan) {
  Scan s{std::vector<std::uint32_t>(m.step_count()), std::vector<std::uint32_t>(m.step_count())};
  Readings(m, grid).read(scan, s.distances, s.intensities);
  return s;
}

Scan read(const Model& m, const std::vector<double>& ranges, double max_range = 10) {
  return read(m, grid_of(m), {ranges, ranges, {}, max_range});
}

TEST(Scip2Readings, EachStepReadsItsRayToTheMillimetre) {
  const Model m = urg_04lx();
  std::vector<double> ranges;
  for (std::uint32_t i = 0; i < m.step_count(); ++i) ranges.push_back(0.5 + 0.0073 * i);
  const Scan s = read(m, ranges);
  for (std::uint32_t i = 0; i < m.step_count(); ++i) EXPECT_NEAR(s.distances[i], 1e3 * ranges[i], 0.501);
}

TEST(Scip2Readings, TheNearestRayCountsAndAFullTurnHasNoGap) {
  const Model m = urg_04lx();
  const std::uint32_t columns = 4096;
  for (const double first : {-pi, 0.0, 0.3}) {
    const RayGrid grid{first, 2 * pi / columns, columns, 0};
    EXPECT_EQ(Readings(m, grid).steps_without_ray(), 0u);
    std::vector<double> ranges;
    for (std::uint32_t i = 0; i < columns; ++i)  // the range depends on the direction of the ray
      ranges.push_back(2 + std::cos(first + 2 * pi * i / columns) + 0.3 * std::sin(first + 2 * pi * i / columns));
    const Scan s = read(m, grid, {ranges, ranges, {}, 10});
    for (std::int32_t step = m.first_step; step <= m.last_step; ++step) {
      const double a = m.angle_of(step);
      EXPECT_NEAR(s.distances[std::size_t(step - m.first_step)], 1e3 * (2 + std::cos(a) + 0.3 * std::sin(a)), 2.5);
    }
  }
}

TEST(Scip2Readings, StepsWithoutRayReadZero) {
  const Model m = urg_04lx();
  const RayGrid narrow{m.angle_of(100), 2 * pi / 1024, 201, 0};
  EXPECT_EQ(Readings(m, narrow).steps_without_ray(), 682u - 201u);
  const std::vector<double> ranges(201, 2.0);
  const Scan s = read(m, narrow, {ranges, ranges, {}, 10});
  EXPECT_EQ(s.distances[100 - 44 - 1], 0u);
  EXPECT_EQ(s.distances[100 - 44], 2000u);
  EXPECT_EQ(s.distances[300 - 44], 2000u);
  EXPECT_EQ(s.distances[300 - 44 + 1], 0u);
}

TEST(Scip2Readings, TheRowThatIsNamedIsRead) {
  const Model m = urg_04lx();
  RayGrid grid = grid_of(m);
  std::vector<double> ranges(3 * 682, 1.0);
  std::fill(ranges.begin() + 682, ranges.begin() + 2 * 682, 2.0);
  grid.first_ray = 682;
  EXPECT_EQ(read(m, grid, {ranges, ranges, {}, 10}).distances, std::vector<std::uint32_t>(682, 2000));
}

TEST(Scip2Readings, NoReturnAndTooNearAreErrorCodes) {
  const Model m = urg_04lx();
  std::vector<double> ranges(682, 2.0);
  ranges[10] = 10, ranges[11] = 5.601, ranges[13] = 5.6;
  ranges[20] = 0.019, ranges[22] = 0.02, ranges[24] = std::numeric_limits<double>::quiet_NaN(), ranges[26] = 0;
  const Scan s = read(m, ranges);
  EXPECT_EQ(s.distances[10], 0u);
  EXPECT_EQ(s.distances[11], 0u);
  EXPECT_EQ(s.distances[13], 5600u);
  EXPECT_EQ(s.distances[20], 19u);
  EXPECT_EQ(s.distances[22], 20u);
  EXPECT_EQ(s.distances[24], 0u);
  EXPECT_EQ(s.distances[26], 0u) << "a lost reading";
  for (const std::size_t i : {10u, 20u, 24u}) EXPECT_EQ(s.intensities[i], 0u);
  const Model utm = utm_30lx();
  const Scan far = read(utm, std::vector<double>(utm.step_count(), 30.0), 30.0);
  EXPECT_EQ(far.distances, std::vector<std::uint32_t>(1081, 1));
  const Model ust = ust_10lx();
  EXPECT_EQ(read(ust, std::vector<double>(1081, 30.0), 30.0).distances[500], 65533u);
}

TEST(Scip2Readings, LongRunsWithoutReturnHaveSevensAtTheirEdges) {
  const Model m = urg_04lx();
  std::vector<double> ranges(682, 2.0);
  for (std::size_t i = 0; i < 5; ++i) ranges[i] = ranges[100 + i] = 10;
  ranges[200] = ranges[201] = 10;
  const Scan s = read(m, ranges);
  EXPECT_EQ(std::vector<std::uint32_t>(s.distances.begin() + 99, s.distances.begin() + 106),
            (std::vector<std::uint32_t>{2000, 7, 0, 0, 0, 7, 2000}));
  EXPECT_EQ(s.distances[0], 0u) << "nothing stands beside the first step";
  EXPECT_EQ(s.distances[4], 7u);
  EXPECT_EQ(s.distances[200] + s.distances[201], 0u) << "a short run";
  EXPECT_EQ(read(m, std::vector<double>(682, 10)).distances, std::vector<std::uint32_t>(682, 0));
}

TEST(Scip2Readings, NoiseHidesNoReturn) {
  const Model m = urg_04lx();
  const std::vector<double> truth(682, 5.0), noisy(682, 4.9);
  EXPECT_EQ(read(m, grid_of(m), {noisy, truth, {}, 5.0}).distances[300], 0u) << "the truth is the greatest range";
}

/// Measures a wall at x = 1 m.
TEST(Scip2Readings, IntensityFallsWithDistanceAndIncidence) {
  const Model m = urg_04lx();
  std::vector<double> ranges, incidence;
  for (std::int32_t step = m.first_step; step <= m.last_step; ++step) {
    const double a = m.angle_of(step);
    ranges.push_back(std::cos(a) > 0.2 ? 1 / std::cos(a) : 10);
    incidence.push_back(std::cos(a) > 0.2 ? a : 0);
  }
  const Scan estimated = read(m, ranges);
  const Scan known = read(m, grid_of(m), {ranges, ranges, incidence, 10});
  for (std::int32_t step = 384 - 190; step <= 384 + 190; ++step) {
    const double a = m.angle_of(step);
    const auto i = std::size_t(step - m.first_step);
    const double expected = 10000 * std::cos(a) / (1 + ranges[i] * ranges[i]);
    EXPECT_NEAR(known.intensities[i], expected, 5) << step;
    EXPECT_NEAR(estimated.intensities[i], expected, 0.1 * expected) << step << ": distances are whole millimetres";
  }
  EXPECT_EQ(known.intensities[340], 5000u);
}

}  // namespace
}  // namespace muro::scip2
