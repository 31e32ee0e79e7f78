// SPDX-License-Identifier: MIT
// Every laser method over ground from a heightmap file.
#include <algorithm>

#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/laser/room.hpp"

namespace muro {
namespace {

using namespace test;

class EveryLaserOnGround : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Conformance, EveryLaserOnGround, testing::ValuesIn(laser_methods()), method_name);

/// m: resolution of a picture of 16 bits that is 8 m high.
constexpr double rounding = 8.0 / 65535;

/// An inclined plane of 32 x 32 m, from 0 to 8 m high.
double incline(double x, double) { return 4 + 0.25 * x; }

TEST_P(EveryLaserOnGround, ReadsAnInclinedPlane) {
  Room s({{0, 0, 6}, from_rpy(0.1, 0.2, 0.5)});
  const ObjectId hill = s.put_heightmap("hill", {32, 32, 8}, incline);
  s.add_laser(GetParam(), {{"rays", std::int64_t(80)},
                           {"rows", std::int64_t(40)},
                           {"min_elevation", -1.2},
                           {"max_elevation", -0.4},
                           {"hits", true}});
  s.build_and_run();
  const Bound bound = bound_of(GetParam(), 0.8 / 39, 1);
  int hits = 0;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 80; ++column) {
      const double e = -1.2 + row * 0.8 / 39, a = -pi + column * 2 * pi / 80;
      const Vec3 d = from_rpy(0.1, 0.2, 0.5) * Vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const double down = 0.25 * d.x() - d.z(), exact = 2 / down;
      const Vec3 point = Vec3(0, 0, 6) + exact * d;
      if (down < 0.25 || exact > 19 || point.head<2>().cwiseAbs().maxCoeff() > 13) continue;  // not near the rim
      const int ray = row * 80 + column;
      EXPECT_NEAR(s.ranges(0)[ray], exact, (rounding + 1e-5) / down + bound.absolute + bound.relative * exact);
      EXPECT_EQ(s.hits(0)[ray], hill);
      ++hits;
    }
  EXPECT_GT(hits, 1500);
}

TEST_P(EveryLaserOnGround, SeesItsWallFromBesideAndNothingBeyondItsRim) {
  Room s({{-18, 0, 1}, Quat::Identity()});
  s.put_heightmap("hill", {32, 32, 8}, [](double x, double y) { return 8 - incline(x, y); });  // 8 m high at x = -16
  s.add_laser(GetParam(), {{"directions", std::vector<double>{0, 0, 0, 0.5, pi / 2, 0, pi, 0, 0, -0.3}}});
  s.build_and_run();
  const double expected[] = {2, 2 / std::cos(0.5), 20, 20, 2 / std::cos(0.3)};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(s.ranges(0)[i], expected[i], 2e-4) << i;
}

TEST_P(EveryLaserOnGround, IsBlindUnderGround) {
  for (const double z : {3.9, -30.0}) {
    Room s({{0, 0, z}, from_rpy(0.3, 0.1, 0)});
    const ObjectId hill = s.put_heightmap("hill", {32, 32, 8}, incline);
    s.add_laser(GetParam(), {{"rays", std::int64_t(9)}, {"min_range", 0.02}, {"hits", true}});
    s.build_and_run();
    for (const double r : s.ranges(0)) EXPECT_EQ(r, 0.02) << z;
    for (const ObjectId hit : s.hits(0)) EXPECT_EQ(hit, hill);
  }
}

TEST_P(EveryLaserOnGround, SeesWhatStandsOnItBeforeWhatIsBehind) {
  Room s({{0, 0, 5}, Quat::Identity()});
  const ObjectId hill = s.put_heightmap("hill", {32, 32, 8}, incline);
  const ObjectId box = s.put("box", Shape::box({1, 1, 1}), {{2.5, 0, 5}, Quat::Identity()});
  s.add_laser(GetParam(), {{"directions", std::vector<double>{0, 0, 0.5, 0}}, {"hits", true}});
  s.build_and_run();
  EXPECT_NEAR(s.ranges(0)[0], 2, 2e-4);
  EXPECT_EQ(s.hits(0)[0], box);
  EXPECT_NEAR(s.ranges(0)[1], 4 / std::cos(0.5), 2e-3) << "where the incline is 5 m high";
  EXPECT_EQ(s.hits(0)[1], hill);
}

TEST_P(EveryLaserOnGround, AgreesWithTheOthersOnHills) {
  const auto hills = [](double x, double y) { return 4 + 2 * std::sin(0.4 * x + 1) * std::cos(0.3 * y) + std::sin(y); };
  Room s({{1, -2, 7.5}, from_rpy(0.05, 0.1, 0.4)});
  s.put_heightmap("hills", {32, 32, 8}, hills, {{0.5, 0.25, 0.1}, from_rpy(0.02, -0.03, 0.7)});
  s.scatter(3, 20);
  Settings grid = grid_100();
  grid["min_elevation"] = -1.2, grid["max_elevation"] = -0.2;
  const std::size_t tried = s.add_laser(GetParam(), grid), exact = s.add_laser("laser.raycast", grid);
  s.build_and_run();
  std::vector<double> errors;
  int hits = 0;
  for (std::size_t i = 0; i < 10000; ++i) {
    errors.push_back(std::abs(s.ranges(tried)[i] - s.ranges(exact)[i]));
    hits += s.ranges(exact)[i] < 20;
  }
  EXPECT_GT(hits, 8000);
  std::sort(errors.begin(), errors.end());
  const bool blurs = bound_of(GetParam(), 1, 1).blur > 0;
  EXPECT_LT(errors[5000], blurs ? 2e-3 : 1e-5);
  EXPECT_LT(errors[9500], blurs ? 0.05 : 1e-4) << "the others are at ridges and edges, or graze the ground";
}

}  // namespace
}  // namespace muro
