// SPDX-License-Identifier: MIT
// Errors of its IMU that the walk tolerates: those of real parts by their data sheets; and larger biases, with which
// the robot falls.
#include <gtest/gtest.h>

#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

constexpr double falls_below = 0.2;  // m: its trunk walks at 0.255 m

/// Returns overrides with an MTi-1 whose gyroscope has a further error, such as "bias: [0, 0.1, 0]" (rad/s).
std::vector<std::string> with_gyro(const std::string& error, const std::string& numbers = "forward=0.1",
                                   const std::string& motion = "articulated") {
  const std::string part = "={use: sensor.error, on: imu, part: mti1, of: ";
  return {"robots.walker.motion.use=motion." + motion, tunables(numbers),
          "robots.walker.imu_error" + part + "angular_velocity, " + error + "}",
          "robots.walker.acceleration_error" + part + "linear_acceleration}"};
}

/// Returns the way (m) in `seconds`, and the least height of the trunk.
std::pair<double, double> walk(const std::vector<std::string>& overrides, double seconds) {
  Walker walker(overrides);
  walker.run(seconds);
  return {walker.pose().position.x(), walker.least_height()};
}

TEST(ImuError, OfTwentyDegreesPerSecondIsMeasuredBeforeTheFirstStep) {
  // the zero-rate output of an MPU-6050 by its data sheet, on each axis
  for (const char* bias : {"bias: [0.35, 0, 0]", "bias: [0, 0.35, 0]", "bias: [0, -0.35, 0]", "bias: [0, 0, 0.35]"}) {
    const auto [way, height] = walk(with_gyro(bias), 8);
    EXPECT_GT(way, 0.4) << bias;
    EXPECT_GT(height, 0.24) << bias;
  }
}

TEST(ImuError, OfAnyPartIsBorne) {
  for (const char* part : {"mti1", "mpu6050", "adis16448"}) {
    const auto [way, height] = walk({std::string("robots.walker.imu_error.part=") + part}, 8);
    EXPECT_GT(way, 0.4) << part;
    EXPECT_GT(height, 0.24) << part;
  }
}

TEST(ImuError, ThatIsNotMeasuredIsBorneWhileItIsSmall) {
  const auto [way, height] = walk(with_gyro("bias: [0, 0.05, 0]", "forward=0.1, calibrate=0"), 12);
  EXPECT_GT(way, 0.8);
  EXPECT_GT(height, 0.24);
}

TEST(ImuError, ThatIsNotMeasuredFellsItWhenItIsLarge) {
  for (const char* bias : {"bias: [0.4, 0, 0]", "bias: [0, 0.4, 0]", "bias: [0, -0.4, 0]"}) {
    const auto [way, height] = walk(with_gyro(bias, "forward=0.1, calibrate=0"), 8);
    EXPECT_LT(height, falls_below) << bias;
  }
}

TEST(ImuError, ThatIsTooLargeToBeMeasuredFellsIt) {
  EXPECT_LT(walk(with_gyro("bias: [0, 0.5, 0]"), 5).second, falls_below);
}

TEST(ImuError, ThatDriftsIsBorneUntilItIsTooFast) {
  // rad/s/sqrt(s), after 30 s a standard deviation of 0.05 and of 0.5 rad/s; an MTi-1's bias drifts by 5e-5 rad/s
  EXPECT_GT(walk(with_gyro("random_walk: [0, 0.01, 0]"), 30).second, 0.24);
  EXPECT_LT(walk(with_gyro("random_walk: [0, 0.1, 0]"), 30).second, falls_below);
}

TEST(ImuError, SlowFellsItAtEachMotionWithForces) {
  const char* const numbers = "forward=0.1, calibrate=0";
  for (const char* motion : {"simplified", "articulated", "mujoco", "bullet"}) {
    EXPECT_GT(walk(with_gyro("bias: [0, 0.05, 0]", numbers, motion), 20).second, 0.23) << motion;
    EXPECT_LT(walk(with_gyro("bias: [0, 0.3, 0]", numbers, motion), 20).second, falls_below) << motion;
  }
  EXPECT_GT(walk(with_gyro("bias: [0, 0.3, 0]", numbers, "biped"), 20).second, 0.24) << "which knows no forces";
}

}  // namespace
}  // namespace muro::walk_test
