// SPDX-License-Identifier: MIT
// Off-road vehicles at two levels cross the hills, checked by the pose of each and the surface of hills.png.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "host/scenario/heightmap_files.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string folder = MURO_TEST_SOURCE_DIR "/examples/offroad";

struct Crossing {
  std::vector<double> most_tilt;   ///< rad, of each vehicle
  std::vector<double> most_above;  ///< m: greatest and least height of a vehicle's middle above the ground
  std::vector<double> least_above;
  std::vector<Vec3> end;
  std::vector<std::string> names;
};

/// Drives for `seconds`.
Crossing drive(double seconds, const std::vector<std::string>& overrides = {}) {
  BuiltScenario built = build(read_scenario(folder + "/offroad.yaml", overrides), test::plugins());
  HeightmapFiles files(*built.simulation);
  const Heightmap hills = files.of(folder + "/hills.png", {48, 48, 4});
  const World& world = built.simulation->world();
  Crossing seen;
  const std::size_t count = world.robots().size();
  seen.most_tilt.assign(count, 0), seen.most_above.assign(count, 0), seen.least_above.assign(count, 1e9);
  seen.end.resize(count);
  for (const RobotView* robot : world.robots()) seen.names.emplace_back(robot->name);
  for (int i = 0; i < 10 * seconds; ++i) {
    built.simulation->run_for(0.1);
    for (std::size_t r = 0; r < count; ++r) {
      const Pose& pose = world.value(world.robots()[r]->base(), keys::pose);
      const auto ground = hills.ground_at(pose.position.x(), pose.position.y());
      if (!ground) {
        ADD_FAILURE() << seen.names[r] << " has left the map";
        return seen;
      }
      seen.most_tilt[r] = std::max(seen.most_tilt[r], std::acos((pose.orientation * Vec3::UnitZ()).z()));
      const double above = pose.position.z() - ground->height;
      if (i > 10) {  // the vehicle has been put down
        seen.most_above[r] = std::max(seen.most_above[r], above);
        seen.least_above[r] = std::min(seen.least_above[r], above);
      }
      seen.end[r] = pose.position;
    }
  }
  return seen;
}

constexpr double degree = M_PI / 180;

TEST(Offroad, VehiclesStandAndDriveOnTheHillsAtBothLevels) {
  const Crossing seen = drive(8);
  ASSERT_EQ(seen.names.size(), 8u);
  for (std::size_t r = 0; r < 8; ++r) {
    EXPECT_GT(seen.end[r].x(), -17) << seen.names[r];
    EXPECT_GT(seen.least_above[r], 0.07) << seen.names[r];
    EXPECT_LT(seen.most_above[r], 0.12) << seen.names[r] << ": wheels are 0.09 m below its middle";
  }
}

TEST(Offroad, SlowAllCrossTheRidgeByItsPassesAndReachTheirGoals) {
  const Crossing seen = drive(110);
  for (std::size_t r = 0; r < 8; ++r) {
    const bool dynamic = seen.names[r].rfind("dynamic", 0) == 0;
    const double goal = (dynamic ? -2 : 2) + 8 * (double(r % 4) - 1.5);
    EXPECT_LT(std::hypot(seen.end[r].x() - 19, seen.end[r].y() - goal), 1.2) << seen.names[r];
    EXPECT_LT(seen.most_tilt[r], 25 * degree) << seen.names[r];
  }
}

TEST(Offroad, SlowVehiclesThatTakeEverySlopeLeanOverOnTheRidge) {
  const Crossing seen =
      drive(60, {"robots.kinematic.control.tunables=[goal_x=19, goal_y=2, goal_spacing=8, max_slope=100]",
                 "robots.dynamic.count=0"});
  EXPECT_GT(*std::max_element(seen.most_tilt.begin(), seen.most_tilt.end()), 35 * degree);
}

}  // namespace
}  // namespace muro::host
