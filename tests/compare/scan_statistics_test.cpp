// SPDX-License-Identifier: MIT
// Statistics of scans that are made with known statistics.
#include "host/tools/compare/scan_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "muro/base/random.hpp"

namespace muro::host {
namespace {

constexpr double beam_step = 2 * M_PI / 1024;

/// Returns scans of `range(beam, scan)` in `beams` around the front, in steps of a URG-04LX.
ScanRecord scans_of(std::size_t scans, std::size_t beams,
                    const std::function<double(std::size_t, std::size_t)>& range) {
  ScanRecord r;
  for (std::size_t i = 0; i < beams; ++i) r.angles.push_back((double(i) - 0.5 * double(beams - 1)) * beam_step);
  for (std::size_t s = 0; s < scans; ++s) {
    r.ranges.emplace_back();
    for (std::size_t i = 0; i < beams; ++i) r.ranges.back().push_back(range(i, s));
  }
  return r;
}

double wall_at(double distance, double angle) { return distance / std::cos(angle); }

/// Independent standard normal numbers for each beam and scan.
class Noise {
 public:
  double operator()(std::size_t beam, std::size_t scan) const { return Random(7, beam, 0).normal(std::uint32_t(scan)); }
};

const StatisticsBand& band_at(const std::vector<StatisticsBand>& bands, double from) {
  for (const StatisticsBand& b : bands)
    if (std::abs(b.from - from) < 1e-9) return b;
  ADD_FAILURE() << "no band from " << from;
  return bands.front();
}

TEST(ScanStatistics, NoiseOfAWallIsThatOfItsBeams) {
  const Noise noise;
  const ScanRecord r = scans_of(200, 200, [&](std::size_t i, std::size_t s) {
    return wall_at(2, (double(i) - 99.5) * beam_step) + 0.005 * noise(i, s);
  });
  const ScanStatistics s = statistics_of(r);
  ASSERT_EQ(s.by_range.size(), 1u) << "2 to 2.4 m";
  const StatisticsBand& b = s.by_range.front();
  EXPECT_EQ(b.from, 1.5);
  EXPECT_EQ(b.over_time.count, 200u);
  EXPECT_NEAR(b.over_time.median, 0.005, 0.00005);
  // relative spread of the standard deviation of n readings: 1 / sqrt(2 n); 10 % of them are lower by 1.28 of it
  EXPECT_NEAR(b.over_time.low, 0.005 * (1 - 1.28 / 20), 0.0001);
  EXPECT_NEAR(b.over_time.high, 0.005 * (1 + 1.28 / 20), 0.0001);
  EXPECT_EQ(b.about_walls.count, 200u * 9) << "nine pieces of 21 beams";
  EXPECT_NEAR(b.about_walls.median, 0.005 * std::sqrt(1 - 2 / (3.0 * 19)), 0.0001) << "the median of chi of 19";
  EXPECT_NEAR(s.neighbour_correlation, 0, 0.02);
  EXPECT_EQ(s.resolution, 0);
  EXPECT_EQ(s.edges, 0u);
}

TEST(ScanStatistics, NeighboursThatAreCorrelatedAreSeen) {
  const Noise noise;
  std::vector<double> before(300);
  const ScanRecord r = scans_of(300, 300, [&](std::size_t i, std::size_t s) {
    const double e = noise(i, s);
    before[s] = i == 0 ? e : 0.52 * before[s] + std::sqrt(1 - 0.52 * 0.52) * e;
    return 1.2 + 0.0023 * before[s];
  });
  const ScanStatistics s = statistics_of(r);
  EXPECT_NEAR(s.neighbour_correlation, 0.52, 0.01);
  EXPECT_NEAR(band_at(s.by_range, 1).over_time.median, 0.0023, 0.00003);
}

TEST(ScanStatistics, StepsOfTheReadingsAreFound) {
  const Noise noise;
  const double sigma = 2;  // mm
  const ScanRecord r =
      scans_of(200, 200, [&](std::size_t i, std::size_t s) { return 1e-3 * std::round(1000 + sigma * noise(i, s)); });
  double same = 0;  // probability that two readings are equal: sum of the squares of the probabilities of each step
  for (int k = -20; k <= 20; ++k) {
    const double p =
        0.5 * (std::erf((k + 0.5) / (sigma * std::sqrt(2.0))) - std::erf((k - 0.5) / (sigma * std::sqrt(2.0))));
    same += p * p;
  }
  const ScanStatistics s = statistics_of(r);
  EXPECT_NEAR(s.resolution, 1e-3, 1e-12);
  EXPECT_NEAR(s.equal_neighbours, same, 0.01);
}

/// Posts at 1 m before a wall at 3 m, ten beams each: an edge every ten beams.
double post(std::size_t beam) { return (beam / 10) % 2 == 0 ? 1 : 3; }

TEST(ScanStatistics, MixedReadingsAtEdgesAreCounted) {
  // every tenth edge has a reading in between, and every tenth has none; each scan has other edges
  const ScanRecord r = scans_of(50, 600, [&](std::size_t i, std::size_t s) {
    const bool at_edge = i % 10 == 0 && i > 0;
    if (at_edge && (i / 10 + s) % 10 == 3) return 1.7;
    if (at_edge && (i / 10 + s) % 10 == 7) return no_range;
    return post(i);
  });
  const ScanStatistics s = statistics_of(r);
  EXPECT_EQ(s.edges, 50u * 59);
  EXPECT_NEAR(s.mixed_share(), 0.1, 0.005);
  EXPECT_NEAR(double(s.lost_edges) / double(s.edges), 0.1, 0.005);
}

TEST(ScanStatistics, WallsAtASlantHaveNoEdges) {
  // at most 15 m away, under 80 degrees: neighbours differ by 0.09 m
  const ScanRecord r =
      scans_of(20, 100, [&](std::size_t i, std::size_t) { return 0.5 / std::cos(0.77 + double(i) * beam_step); });
  const ScanStatistics s = statistics_of(r);
  EXPECT_EQ(s.edges, 0u);
  EXPECT_EQ(s.steady_beams, 100u);
}

TEST(ScanStatistics, NoiseByIncidenceIsToldApart) {
  const Noise noise;
  // a wall that is perpendicular straight ahead: the angle of a beam is its angle of incidence
  const ScanRecord r = scans_of(100, 290, [&](std::size_t i, std::size_t s) {
    const double angle = (double(i) - 144.5) * beam_step, incidence = std::abs(angle) * 180 / M_PI;
    return wall_at(1.1, angle) + (incidence < 20 ? 0.002 : 0.004) * noise(i, s);
  });
  const ScanStatistics s = statistics_of(r);
  EXPECT_NEAR(band_at(s.by_incidence, 0).about_walls.median, 0.002, 0.0001);
  EXPECT_NEAR(band_at(s.by_incidence, 20 * M_PI / 180).about_walls.median, 0.004, 0.0002);
}

TEST(ScanStatistics, DropOutsAreNoBeamsWithoutReturn) {
  const ScanRecord r = scans_of(500, 400, [&](std::size_t i, std::size_t s) {
    if (i >= 300) return no_range;
    return Random(3, i, 1).uniform(std::uint32_t(s)) < 0.03 ? no_range : 1.0;
  });
  const ScanStatistics s = statistics_of(r);
  EXPECT_NEAR(s.drop_outs, 0.03, 3 * std::sqrt(0.03 * 0.97 / (300 * 500)));
  EXPECT_EQ(s.without_return, 0.25);
  EXPECT_EQ(s.steady_beams, 298u) << "the two at the edge of what returns do not count";
}

TEST(ScanStatistics, BiasIsThatAgainstTheTrueRanges) {
  const Noise noise;
  const ScanRecord r = scans_of(100, 100, [&](std::size_t i, std::size_t s) { return 2.012 + 0.003 * noise(i, s); });
  std::vector<double> truth(100, 2.0);
  truth[50] = no_range, truth[51] = 7;
  const Spread bias = statistics_of(r, truth).by_range.front().bias;
  EXPECT_EQ(bias.count, 98u) << "one is not known, one is another surface";
  EXPECT_NEAR(bias.median, 0.012, 0.0002);
  EXPECT_EQ(statistics_of(r).by_range.front().bias.count, 0u);
}

TEST(ScanStatistics, WhatMovesIsNoNoise) {
  const Noise noise;
  const ScanRecord r = scans_of(100, 100, [&](std::size_t i, std::size_t s) {
    const bool somebody = i >= s % 50 && i < s % 50 + 5;
    return (somebody ? 1 : 3) + 0.002 * noise(i, s);
  });
  const ScanStatistics s = statistics_of(r);
  EXPECT_GT(s.unsteady_beams, 50u);
  EXPECT_NEAR(band_at(s.by_range, 2.5).over_time.median, 0.002, 0.0001);
}

TEST(ScanStatistics, FewScansTellNoNoiseOverTime) {
  const Noise noise;
  const ScanRecord r = scans_of(1, 105, [&](std::size_t i, std::size_t s) {
    return wall_at(2, (double(i) - 52) * beam_step) + 0.005 * noise(i, s);
  });
  const ScanStatistics s = statistics_of(r);
  EXPECT_EQ(s.by_range.front().over_time.count, 0u);
  EXPECT_EQ(s.by_range.front().about_walls.count, 5u);
  EXPECT_NEAR(s.by_range.front().about_walls.median, 0.005, 0.001);
}

}  // namespace
}  // namespace muro::host
