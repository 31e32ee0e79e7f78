// SPDX-License-Identifier: MIT
// Scans that take time, on a robot that drives.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/laser/room.hpp"

namespace muro {
namespace {

using namespace test;

class EverySweep : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Conformance, EverySweep, testing::ValuesIn(laser_methods()), method_name);

constexpr int sweep_rays = 240;
const Settings sweep_settings{
    {"rays", std::int64_t(sweep_rays)}, {"min_angle", -2.0}, {"max_angle", 2.0}, {"max_range", 30.0}};

/// A room without visible corners, and a carrier that drives an arc in it: 1 m/s, 2 rad/s.
struct Drive : Room {
  const double v = 1, w = 2;

  Drive() : Room({{0, 0, 1}, Quat::Identity()}) {
    put("around", Shape::box({0.2, 60, 60}), {{6.1, 0, 0}, Quat::Identity()});
  }
  void start() {
    motion_rate = 1000;
    laser_rate = 100;
    build_and_run(0.0005);
    world().value(carrier->base(), keys::command_twist) = {{v, 0, 0}, {0, 0, w}};
  }
  /// Returns position (x, y) and heading of the carrier at t (s).
  Vec3 at(double t) const {
    const double r = v / w;
    return {r * std::sin(w * t), r * (1 - std::cos(w * t)), w * t};
  }
  /// Returns the reading of a ray at `azimuth` at t: the wall at x = 6.
  double exact(double t, double azimuth) const {
    const Vec3 pose = at(t);
    const double c = std::cos(pose.z() + azimuth);
    return c > 0 ? std::min(30.0, (6 - pose.x()) / c) : 30;
  }
};

double azimuth_of(int ray) { return -2 + 4.0 * ray / (sweep_rays - 1); }
/// Returns the time of a ray in a scan of 0.1 s, a turn of the mirror, that begins at `start`.
double time_of(int ray, double start) { return start + 0.1 * (azimuth_of(ray) + 2) / (2 * pi); }

TEST_P(EverySweep, TakesEachRayAtItsOwnTimeAlongThePathOfTheDevice) {
  Drive s;
  s.add_laser(GetParam(), with(sweep_settings, {{"sweep_steps", std::int64_t(10)}}));
  s.start();
  s.run_for(0.2005);  // two scans: from 0 to 0.1 s and from 0.1 to 0.2 s; motion has begun with the first step
  const bool exact = GetParam() == "laser.raycast" || GetParam() == "laser.embree";
  double worst = 0;
  for (int i = 0; i < sweep_rays; ++i) {
    const double expected = s.exact(time_of(i, 0.1) - 0.001, azimuth_of(i));
    if (expected > 12) continue;
    worst = std::max(worst, std::abs(s.ranges(0)[i] - expected));
  }
  // a slice is taken at its middle: at most half of 10 ms off; by then a far wall moves by 0.06 m, or more at a slant
  EXPECT_LT(worst, exact ? 1e-9 : 0.5) << "exact for rays, by slices for pictures";
}

TEST_P(EverySweep, DiffersFromAScanAtOneInstantByTheWayOfTheDevice) {
  Drive s;
  s.add_laser(GetParam(), with(sweep_settings, {{"sweep_steps", std::int64_t(10)}}));
  s.add_laser(GetParam(), sweep_settings);
  s.start();
  s.run_for(0.2005);
  double most = 0;
  for (int i = 0; i < sweep_rays; ++i)
    if (s.exact(0.2, azimuth_of(i)) < 12) most = std::max(most, std::abs(s.ranges(0)[i] - s.ranges(1)[i]));
  EXPECT_GT(most, 0.3) << "0.2 rad of turning in a scan";
}

TEST_P(EverySweep, IsAScanAtOneInstantWhileTheDeviceStands) {
  Room s({{0.2, 0.3, 1}, from_rpy(0, 0, 0.2)});
  s.furnish();
  s.laser_rate = 100;
  s.add_laser(GetParam(), with(sweep_settings, {{"sweep_steps", std::int64_t(7)}, {"hits", true}}));
  s.add_laser(GetParam(), with(sweep_settings, {{"hits", true}}));
  s.build_and_run(0.2);
  const Bound bound = bound_of(GetParam(), 4.0 / (sweep_rays - 1), 1);
  int edges = 0;
  for (int i = 0; i < sweep_rays; ++i) {
    const bool same = std::abs(s.ranges(0)[i] - s.ranges(1)[i]) <= 2 * (bound.absolute + bound.relative * 10) &&
                      s.hits(0)[i] == s.hits(1)[i];
    edges += !same;
  }
  EXPECT_LE(edges, bound.blur > 0 ? 8 : 0) << "pictures of slices have their pixels elsewhere";
}

TEST_P(EverySweep, KeepsTheLastScanUntilTheNextIsComplete) {
  Drive s;
  s.add_laser(GetParam(), with(sweep_settings, {{"sweep_steps", std::int64_t(10)}}));
  s.start();
  s.run_for(0.1505);
  const std::vector<double> first(s.ranges(0).begin(), s.ranges(0).end());
  s.run_for(0.01);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), s.ranges(0).begin()));
  s.run_for(0.04);
  EXPECT_FALSE(std::equal(first.begin(), first.end(), s.ranges(0).begin()));
}

}  // namespace
}  // namespace muro
