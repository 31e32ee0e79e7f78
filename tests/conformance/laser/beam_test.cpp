// SPDX-License-Identifier: MIT
// Beams that are wider than a line, and the effect of their incidence on noise.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/laser/room.hpp"

namespace muro {
namespace {

using namespace test;

class EveryBeam : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Conformance, EveryBeam, testing::ValuesIn(laser_methods()), method_name);

TEST_P(EveryBeam, TellsTheIncidenceOnAWall) {
  Room s;
  s.put("wall", Shape::box({0.2, 20, 20}), {{2.1, 0, 1}, Quat::Identity()});
  s.add_laser(GetParam(), {{"rays", std::int64_t(121)}, {"min_angle", -1.2}, {"max_angle", 1.2}, {"incidence", true}});
  s.build_and_run();
  for (int i = 0; i <= 120; ++i) {
    EXPECT_NEAR(s.incidence(0)[i], std::abs(-1.2 + 0.02 * i), 0.02) << i;
    EXPECT_NEAR(s.ranges(0)[i], 2 / std::cos(-1.2 + 0.02 * i), 1e-3);
  }
}

TEST_P(EveryBeam, ReadsBetweenBothSidesOfAnEdgeThatLiesInIt) {
  Room s;
  s.put("near", Shape::box({0.2, 4, 4}), {{2.1, 2, 1}, Quat::Identity()});  // with its edge straight ahead
  s.put("far", Shape::box({0.2, 20, 20}), {{4.1, 0, 1}, Quat::Identity()});
  Settings narrow{{"rays", std::int64_t(401)}, {"min_angle", -0.02}, {"max_angle", 0.02}};
  s.add_laser(GetParam(), narrow);
  s.add_laser(GetParam(), with(narrow, {{"divergence", 0.01}}));
  s.build_and_run();
  int mixed[2] = {};
  for (const std::size_t scanner : {0u, 1u})
    for (const double r : s.ranges(scanner)) mixed[scanner] += r > 2.01 && r < 3.99;
  EXPECT_EQ(mixed[0], 0) << "a line is on one side or the other";
  // the ring of seven rays is 0.7359 * 0.01 rad wide, 0.0001 rad between neighbours
  EXPECT_NEAR(mixed[1], 74, 8);
  const double middle = s.ranges(1)[200], lights = 1 / 4.0 + 1 / 16.0;
  EXPECT_NEAR(middle, (2 / 4.0 + 4 / 16.0) / lights, 0.3) << "half of the beam on either side, by their light";
}

/// Share of edges with a reading between both sides: about 8 % (facts/scip2.md).
TEST(AUrg, ReadsBetweenBothSidesAtAFewEdges) {
  int edges = 0, mixed = 0;
  for (int turn = 0; turn < 18; ++turn) {
    Room s({{0, 0, 1}, from_rpy(0, 0, 0.1234 * turn)});
    for (int i = 0; i < 40; ++i) {
      const double a = 2 * pi * (i + 0.37 * (i % 3)) / 40, r = 1 + 0.05 * (i % 7);
      s.put("post" + std::to_string(i), Shape::cylinder(0.04, 4),
            {{r * std::cos(a), r * std::sin(a), 1}, Quat::Identity()});
    }
    s.put("around", Shape::box({0.2, 30, 10}), {{3.1, 0, 1}, Quat::Identity()});
    s.add_laser("laser.raycast", with(urg(), {{"max_range", 20.0}}));
    s.add_laser("laser.raycast", with(urg(), {{"max_range", 20.0}, {"divergence", 0.0023}}));
    s.build_and_run();
    const std::span<double> line = s.ranges(0), beam = s.ranges(1);
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (std::abs(line[i] - line[i - 1]) < 0.3) continue;
      const double low = std::min(line[i], line[i - 1]) + 0.06, high = std::max(line[i], line[i - 1]) - 0.06;
      ++edges;
      mixed += (beam[i] > low && beam[i] < high) || (beam[i - 1] > low && beam[i - 1] < high);
    }
  }
  ASSERT_GT(edges, 500);
  EXPECT_NEAR(double(mixed) / edges, 0.08, 0.02);
}

/// Noise: 2.1 mm at 0 to 20 degrees, 2.5 at 20 to 40, 4.7 at 40 to 60; neighbours correlated by 0.52 (facts/scip2.md).
TEST(AUrg, IsNoisierWhereItsBeamMeetsAWallAtASlant) {
  Room s;
  s.put("wall", Shape::box({0.2, 20, 20}), {{0.9, 0, 1}, Quat::Identity()});
  const std::size_t scanner = s.add_laser(
      "laser.raycast", {{"rays", std::int64_t(343)}, {"min_angle", -1.047}, {"max_angle", 1.047}, {"incidence", true}});
  s.use("sensor.error", 10, {{s.carrier, s.sensor(scanner)}},
        {{"sigma", 0.002}, {"pointing", 0.0027}, {"correlation", 0.52}});
  s.build_and_run();
  double sum[3] = {}, count[3] = {};
  for (int scan = 0; scan < 300; ++scan) {
    s.run_for(0.1);
    const std::span<double> measured = s.world().values(s.sensor(scanner), keys::measured_ranges);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const auto band = std::size_t(s.incidence(scanner)[i] * 180 / pi / 20);
      const double error = measured[i] - s.ranges(scanner)[i];
      if (band < 3) sum[band] += error * error, ++count[band];
    }
  }
  const double expected[] = {0.0021, 0.0025, 0.0047};
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(std::sqrt(sum[band] / count[band]), expected[band], 0.15 * expected[band]) << 20 * band << " degrees";
}

}  // namespace
}  // namespace muro
