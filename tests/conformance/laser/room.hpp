// SPDX-License-Identifier: MIT
// Scenes for laser scanners.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro::test {

using std::numbers::pi;
using Settings = std::map<std::string, ParameterInput>;

/// Returns the ids of all laser scanners of the build.
std::vector<std::string> laser_methods();
/// Returns the method for the name of a test.
std::string method_name(const testing::TestParamInfo<std::string>& test);

/// Returns `settings` with `more`, which has priority.
Settings with(Settings settings, const Settings& more);

/// A carrier without shapes, with any number of scanners on it, and objects around it.
struct Room : Scene {
  const RobotView* carrier = nullptr;

  explicit Room(const Pose& at = {{0, 0, 1}, Quat::Identity()});

  ObjectId put(const std::string& name, const Shape& shape, const Pose& at);
  /// Adds walls with inner faces at x = +-5 and y = +-4, 3 m high, a pillar of radius 0.5 at (2, 2), flat ground at z =
  /// 0.
  void furnish();
  /// Adds boxes, balls, cylinders and capsules at random places, as scenery and as robots, but none within a metre.
  void scatter(unsigned seed, int count);
  /// Adds ground of 129 x 129 nodes over `size` (m) around the origin; `height`: 0 to size.z (m) at x, y (m).
  ObjectId put_heightmap(const std::string& name, const Vec3& size, const std::function<double(double, double)>& height,
                         const Pose& at = {});
  /// Adds a scanner and returns its number. The range is 20 m unless `settings` give another one.
  std::size_t add_laser(const std::string& method, const Settings& settings);
  /// Connects all algorithms and runs for `seconds`.
  void build_and_run(double seconds = 0.005);

  std::span<double> ranges(std::size_t scanner) { return world().values(sensors_[scanner], keys::ranges); }
  std::span<ObjectId> hits(std::size_t scanner) { return world().values(sensors_[scanner], keys::laser_hits); }
  std::span<double> incidence(std::size_t scanner) { return world().values(sensors_[scanner], keys::laser_incidence); }
  ObjectId sensor(std::size_t scanner) const { return sensors_[scanner]; }

  int motion_rate = 100;  ///< 1/s
  int laser_rate = 10;    ///< 1/s

 private:
  struct Laser {
    std::string method;
    Settings settings;
  };
  ScratchFolder folder_;
  std::vector<ObjectId> sensors_;
  std::vector<Laser> lasers_;
};

/// Returns the scanner of the URG-04LX: 682 rays at 2 pi / 1024.
Settings urg();
/// Returns 100 x 100 rays in 60 x 60 degrees.
Settings grid_100();

/// Limits of the difference between a method and exact rays: its own error on a surface, and the angle (rad) within
/// which it may read one side of an edge instead of the other.
struct Bound {
  double relative = 0, absolute = 0;  ///< of the range; m
  double blur = 0;
};
/// Returns the bound for a scanner with `spacing` (rad) between neighbouring rays and `supersampling` pixels for each
/// ray. Pixels of a depth image are spacing / supersampling wide. Its depths are single-precision floats, interpolated
/// over triangles; circles are polygons that lie 0.2 mm inside of them.
Bound bound_of(const std::string& method, double spacing, double supersampling);

}  // namespace muro::test
