// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "plugins/common/wheels/side_wheel_drive_testing.hpp"

namespace muro {
namespace {

using test::WheelPart;
using Settings = std::map<std::string, ParameterInput>;

struct Driven : test::SideWheelVehicle {
  explicit Driven(const RobotTree& tree, Settings settings = {},
                  const std::string& motion = "motion.differential_drive")
      : SideWheelVehicle(tree, "drive.skid_steer", std::move(settings), motion) {}
};

std::vector<WheelPart> wheels_in_rows(int rows) {
  std::vector<WheelPart> wheels;
  for (int i = 0; i < rows; ++i)
    for (const double side : {1.0, -1.0})
      wheels.push_back(
          {.name = (side > 0 ? "left" : "right") + std::to_string(i), .at = {0.3 * i, 0.2 * side, 0}, .radius = 0.1});
  return wheels;
}

TEST(SkidSteer, DrivesFourAndSixWheels) {
  for (const int rows : {2, 3}) {
    Driven s(test::wheeled_robot(wheels_in_rows(rows)));
    s.command(1, 0.5);
    for (int i = 0; i < rows; ++i) {
      EXPECT_NEAR(s.target("left" + std::to_string(i)), 9, 1e-13);
      EXPECT_NEAR(s.target("right" + std::to_string(i)), 11, 1e-13);
    }
    EXPECT_NEAR(s.twist(s.robot).angular.z(), 0.5, 1e-13);
  }
}

TEST(SkidSteer, MakesUpForSlipWithAWiderTrack) {
  Driven s(test::wheeled_robot(wheels_in_rows(2)), {{"track_scale", 1.5}}, "");
  s.command(1, 0.5);
  EXPECT_NEAR(s.target("left0"), (1 - 0.5 * 1.5 * 0.2) / 0.1, 1e-13);
  EXPECT_NEAR(s.target("right1"), (1 + 0.5 * 1.5 * 0.2) / 0.1, 1e-13);
  s.command(1, 0);
  EXPECT_NEAR(s.target("left0"), 10, 1e-13) << "straight ahead nothing slips sideways";
}

TEST(SkidSteer, KeepsTheCurvatureOfAllWheels) {
  Driven s(test::wheeled_robot(wheels_in_rows(3)), {{"max_wheel_speed", 6.0}});
  s.command(-3, 1);
  EXPECT_NEAR(s.target("left0"), -6, 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(s.target("right" + std::to_string(i)) / s.target("left0"), 2.8 / 3.2, 1e-13);
}

}  // namespace
}  // namespace muro
