// SPDX-License-Identifier: MIT
// Two-wheeled robots stand as long as their control code can tolerate the errors of their sensors.
#include <gtest/gtest.h>

#include <map>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string scenario = MURO_TEST_SOURCE_DIR "/examples/balancer/balancer.yaml";

struct Balance {
  double most_tilt = 0;  ///< rad
  double farthest = 0;   ///< m
};

/// Returns the balance of each robot, measured after the second in which it has become upright.
std::map<std::string, Balance> balance(double seconds, const std::vector<std::string>& overrides = {}) {
  BuiltScenario built = build(read_scenario(scenario, overrides), test::plugins());
  const World& world = built.simulation->world();
  std::map<std::string, Balance> seen;
  built.simulation->run_for(1);
  for (double t = 1; t < seconds; t += 0.02) {
    built.simulation->run_for(0.02);
    for (const RobotView* robot : world.robots()) {
      const Pose& pose = world.value(robot->base(), keys::pose);
      Balance& b = seen[std::string(robot->name)];
      b.most_tilt = std::max(b.most_tilt, std::acos((pose.orientation * Vec3::UnitZ()).z()));
      b.farthest = std::max(b.farthest, std::abs(pose.position.x()));
    }
  }
  return seen;
}

constexpr double degree = M_PI / 180;

TEST(Balancer, CalibratedRobotsStandAndTheOtherOneFalls) {
  const auto seen = balance(10);
  ASSERT_EQ(seen.size(), 3u);
  for (const std::string name : {"simplified", "full"}) {
    EXPECT_LT(seen.at(name).most_tilt, 3 * degree) << name;
    EXPECT_LT(seen.at(name).farthest, 0.6) << name;
    EXPECT_GT(seen.at(name).most_tilt, 1e-4) << name << ": its sensors have noise";
  }
  EXPECT_GT(seen.at("uncalibrated").most_tilt, 40 * degree);
}

TEST(Balancer, WithoutErrorsEachStandsStillAtEveryLevel) {
  for (const std::string motion : {"simplified", "ode", "mujoco"}) {
    std::vector<std::string> overrides = {"robots.full.motion.use=motion." + motion};
    for (const std::string robot : {"simplified", "full", "uncalibrated"})
      for (const std::string error : {"imu_error", "acceleration_error"})
        overrides.push_back("robots." + robot + "." + error + "=off");
    for (const auto& [name, b] : balance(5, overrides)) {
      EXPECT_LT(b.most_tilt, 0.5 * degree) << name << ", " << motion;
      EXPECT_LT(b.farthest, 0.06) << name << ", " << motion;
    }
  }
}

TEST(Balancer, SlowWhoBelievesItsGyroRunsAwayFromASmallBias) {
  const std::string bias =
      "={use: sensor.error, on: imu, part: mpu6050, turn_on_bias_tolerance: 0, bias: [0, 0.1, 0], "
      "of: angular_velocity}";
  const auto learns = balance(60, {"robots.simplified.imu_error" + bias, "robots.full=off"});
  const auto believes = balance(60, {"robots.simplified.imu_error" + bias, "robots.full=off",
                                     "robots.simplified.control.tunables=[bias_gain=0]"});
  EXPECT_LT(learns.at("simplified").farthest, 10);
  EXPECT_GT(believes.at("simplified").farthest, 20);
}

}  // namespace
}  // namespace muro::host
