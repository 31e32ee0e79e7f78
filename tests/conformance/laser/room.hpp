// SPDX-License-Identifier: MIT
// Scenes that laser scanners look at.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro::test {

using std::numbers::pi;
using Settings = std::map<std::string, ParameterInput>;

/// The ids of all laser scanners of the build.
std::vector<std::string> laser_methods();
/// For the names of tests.
std::string method_name(const testing::TestParamInfo<std::string>& test);

/// `more` over `settings`.
Settings with(Settings settings, const Settings& more);

/// A carrier without shapes, any number of scanners on it, and things around it.
struct Room : Scene {
  const RobotView* carrier = nullptr;

  explicit Room(const Pose& at = {{0, 0, 1}, Quat::Identity()});

  ObjectId put(const std::string& name, const Shape& shape, const Pose& at);
  /// Walls with their inner faces at x = +-5 and y = +-4, 3 m high, a pillar of radius 0.5 at (2, 2), flat ground at z
  /// = 0.
  void furnish();
  /// Boxes, balls, cylinders, capsules anywhere about, in scenery and as robots, but none within a metre.
  void scatter(unsigned seed, int count);
  /// Ground of 129 x 129 nodes over `size` (m), around the origin, with the height (m) 0 to size.z at x, y (m).
  ObjectId put_heightmap(const std::string& name, const Vec3& size, const std::function<double(double, double)>& height,
                         const Pose& at = {});
  /// A scanner beside those that are there; known by its number. All have a range of 20 m unless told.
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

/// The scanner of the URG-04LX: 682 rays at 2 pi / 1024.
Settings urg();
/// 100 x 100 rays in 60 x 60 degrees.
Settings grid_100();

/// Where a method may differ from exact rays: its own error on a surface, and the angle (rad) within which it may take
/// one side of an edge for the other.
struct Bound {
  double relative = 0, absolute = 0;  ///< of the range; m
  double blur = 0;
};
/// For a scanner whose neighbouring rays are `spacing` (rad) apart, with `supersampling` pixels for each ray. The
/// pixels of a depth image are spacing / supersampling wide; its depths are single-precision floats, interpolated over
/// triangles; circles are polygons that lie 0.2 mm inside of them.
Bound bound_of(const std::string& method, double spacing, double supersampling);

}  // namespace muro::test
