// SPDX-License-Identifier: MIT
// Tests of vehicles with steered wheels on heightmaps.
#include <gtest/gtest.h>

#include "ackermann_testing.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/hills.hpp"

namespace muro {
namespace {

using namespace ackermann;

struct CarOnHills : test::Scene {
  const RobotView& robot;
  CarOnHills(const test::Hills& hills, double rate, const std::vector<WheelSpec>& wheels, const Pose& start)
      : robot((hills.add_to(*this), add("car", vehicle_of(wheels), start))) {
    use("motion.ackermann", rate, all_robots());
    use("kinematics.direct", 2 * rate, all_robots());
    build();
  }
  double& value(const std::string& joint, const Key<double>& key) {
    return world().value("car/" + joint + "_joint", key);
  }
  Pose& at() { return pose(robot); }
};

TEST(AckermannOnTerrain, ABicycleTurnsOnItsCircleInAnInclinedPlaneOfHeights) {
  const test::Hills hills(64, 64, [](double x, double y) { return 0.25 * x - 0.125 * y; });
  const double circle = 2 / std::tan(0.4), angle = 0.1 * 12 * 10 / circle;
  for (const double rate : {5.0, 200.0}) {
    CarOnHills s(hills, rate, bicycle(2), {{1, 2, 0}, from_rpy(0, 0, 0.7)});
    const Pose start = s.at();
    s.value("front_steering", keys::joint_position_target) = 0.4;
    s.value("rear_wheel", keys::joint_velocity_target) = 12;
    s.run_for(10);
    const Pose in_plane = start.inverse() * s.at();
    EXPECT_NEAR(in_plane.position.x(), circle * std::sin(angle), 1e-9) << rate << " Hz";
    EXPECT_NEAR(in_plane.position.y(), circle * (1 - std::cos(angle)), 1e-9);
    EXPECT_NEAR(in_plane.position.z(), 0, 1e-9);
    EXPECT_NEAR((in_plane.orientation * Vec3::UnitZ()).z(), 1, 1e-9) << "upright on the slope";
    EXPECT_NEAR(s.value("rear_wheel", keys::joint_position), 120, 1e-9);
  }
}

TEST(AckermannOnTerrain, ThreeWheelsStandOnTheGroundWhereverTheirArmsSteerThem) {
  const auto height = [](double x, double y) { return 0.4 * std::sin(x) * std::cos(0.7 * y); };
  const test::Hills hills(32, 640, height);
  const std::vector<WheelSpec> wheels{
      {.name = "rear", .at = {0, 0, 0.1}},
      {.name = "front_left", .at = {0.8, 0.3, 0.1}, .steered = true, .arm = {-0.05, 0.12, 0}},
      {.name = "front_right", .at = {0.8, -0.3, 0.1}, .steered = true, .arm = {-0.05, -0.12, 0}}};
  CarOnHills s(hills, 100, wheels, {{1, 2, 0}, from_rpy(0, 0, 0.7)});
  s.value("rear_wheel", keys::joint_velocity_target) = 10;
  for (int i = 0; i < 40; ++i) {
    for (const char* front : {"front_left_steering", "front_right_steering"})
      s.value(front, keys::joint_position_target) = 0.6 * std::sin(0.3 * i);
    s.run_for(0.105);
    for (const WheelSpec& w : wheels) {
      const Pose wheel = s.world().value("car/" + w.name + "_wheel", keys::pose);
      const Vec3 lowest = wheel.position - s.at().orientation * Vec3(0, 0, w.radius);
      EXPECT_NEAR(lowest.z(), height(lowest.x(), lowest.y()), 3e-4) << w.name << ", " << i;
    }
  }
}

}  // namespace
}  // namespace muro
