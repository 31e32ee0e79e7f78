// SPDX-License-Identifier: MIT
// Tests of vehicles with rollers on heightmaps.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/hills.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

constexpr double wheel = 0.05, arm = 0.2;

/// Three omni wheels about their middle, 120 deg apart.
RobotTree kiwi() {
  std::vector<test::WheelPart> wheels;
  for (const double a : {M_PI / 3, M_PI, -M_PI / 3}) {
    const Vec3 out(std::cos(a), std::sin(a), 0);
    test::WheelPart w{
        .name = "w" + std::to_string(wheels.size()), .at = arm * out, .radius = wheel, .axis = -out, .own_shape = true};
    w.shape = Shape::cylinder(wheel, 0.03);
    w.shape.origin.orientation = from_rpy(0, M_PI / 2, a);
    wheels.push_back(w);
  }
  return test::wheeled_robot(wheels);
}

struct KiwiOnHills : test::Scene {
  const RobotView& robot;
  KiwiOnHills(const test::Hills& hills, const Pose& start) : robot((hills.add_to(*this), add("bot", kiwi(), start))) {
    use("motion.omni", 100, all_robots());
    build();
  }
  /// Drives with a velocity (m/s) in the axes of the base.
  void drive(double x, double y) {
    const double angles[] = {M_PI / 3, M_PI, -M_PI / 3};
    for (int i = 0; i < 3; ++i)
      world().value("bot/w" + std::to_string(i) + "_joint", keys::joint_velocity_target) =
          (-std::sin(angles[i]) * x + std::cos(angles[i]) * y) / wheel;
  }
};

TEST(OmniOnTerrain, AllThreeWheelsStandOnTheGroundWhileItGoesSideways) {
  const auto height = [](double x, double y) { return 0.4 * std::sin(x) * std::cos(0.7 * y); };
  const test::Hills hills(32, 640, height);
  KiwiOnHills s(hills, {{1, 2, 0}, from_rpy(0, 0, 0.7)});
  s.drive(0.3, -1);
  for (int i = 0; i < 50; ++i) {
    s.run_for(0.1);
    EXPECT_NEAR(yaw_of(s.pose(s.robot).orientation), 0.7, 1e-9);
    for (const double a : {M_PI / 3, M_PI, -M_PI / 3}) {
      const Vec3 lowest = s.pose(s.robot) * Vec3(arm * std::cos(a), arm * std::sin(a), -wheel);
      EXPECT_NEAR(lowest.z(), height(lowest.x(), lowest.y()), 3e-4) << i;
    }
  }
}

TEST(OmniOnTerrain, GoesStraightAlongAnInclinedPlaneAtTheSpeedOfItsWheels) {
  const test::Hills hills(32, 64, [](double x, double y) { return 0.25 * x - 0.125 * y; });
  KiwiOnHills s(hills, {{1, 2, 0}, from_rpy(0, 0, 0.7)});
  const Pose start = s.pose(s.robot);
  s.drive(0.3, -1);
  s.run_for(5);
  EXPECT_LT((start.inverse() * s.pose(s.robot).position - Vec3(1.5, -5, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace muro
