// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "tests/support/complaint.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using test::WheelPart;
using Settings = std::map<std::string, ParameterInput>;

constexpr double lx = 0.25, ly = 0.2, r = 0.05;

RobotTree mecanum(double limit = 1e3) {
  std::vector<WheelPart> wheels;
  for (const double x : {lx, -lx})
    for (const double y : {ly, -ly})
      wheels.push_back({.name = std::string(x > 0 ? "f" : "r") + (y > 0 ? "l" : "r"),
                        .at = {x, y, r},
                        .limits = {.velocity = limit}});
  return test::wheeled_robot(wheels);
}

struct Driven : test::Scene {
  const RobotView& robot;
  explicit Driven(const RobotTree& tree, Settings settings = {}, const std::string& motion = "motion.omni")
      : robot(add("bot", tree)) {
    if (!motion.empty()) use(motion, 100, all_robots());
    use("drive.omni", 100, all_robots(), std::move(settings));
    build();
  }
  void command(double x, double y, double turn) {
    world().value(robot.base(), keys::command_twist) = {{x, y, 0}, {0, 0, turn}};
    run_for(0.01);
  }
  double target(const std::string& wheel) {
    return world().value("bot/" + wheel + "_joint", keys::joint_velocity_target);
  }
  Vec3 moving() { return pose(robot).orientation.conjugate() * twist(robot).linear; }
  double turning() { return twist(robot).angular.z(); }
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

TEST(OmniDrive, GivesMecanumWheelsTheSpeedsOfTheTextbook) {
  Driven s(mecanum());
  const double x = 0.4, y = 0.3, turn = -0.9, k = lx + ly;
  s.command(x, y, turn);
  EXPECT_NEAR(s.target("fl"), (x - y - k * turn) / r, 1e-13);
  EXPECT_NEAR(s.target("fr"), (x + y + k * turn) / r, 1e-13);
  EXPECT_NEAR(s.target("rl"), (x + y - k * turn) / r, 1e-13);
  EXPECT_NEAR(s.target("rr"), (x - y + k * turn) / r, 1e-13);
}

TEST(OmniDrive, MovesTheModelsOfTheExamplesAsCommanded) {
  Draw draw{std::mt19937(1)};
  test::Scene reader;
  for (const char* model : {"mecanum", "kiwi"}) {
    Driven s(reader.read_model(std::string(MURO_TEST_SOURCE_DIR "/examples/models/") + model + ".urdf"));
    for (int round = 0; round < 20; ++round) {
      const double x = draw(-0.3, 0.3), y = draw(-0.3, 0.3), turn = draw(-0.5, 0.5);
      s.command(x, y, turn);
      EXPECT_LT((s.moving() - Vec3(x, y, 0)).norm(), 1e-12) << model;
      EXPECT_NEAR(s.turning(), turn, 1e-12) << model;
    }
  }
}

TEST(OmniDrive, KeepsTheDirectionWhenAWheelIsAtItsLimit) {
  for (const double limit : {1e9, 5.0}) {
    Driven s(mecanum(12), {{"max_wheel_speed", limit}});
    s.command(1, 2, 3);  // greatest speed, of fr: (1 + 2 + 1.35) / 0.05 = 87
    const double part = std::min(limit, 12.0) / 87;
    EXPECT_NEAR(s.target("fr"), std::min(limit, 12.0), 1e-12);
    EXPECT_LT((s.moving() - part * Vec3(1, 2, 0)).norm(), 1e-12);
    EXPECT_NEAR(s.turning(), part * 3, 1e-12);
    s.command(0.1, 0, 0);
    EXPECT_NEAR(s.target("fr"), 2, 1e-13) << "a slow command is left as it is";
  }
}

TEST(OmniDrive, IsNoErrorOnALevelWithoutWheels) {
  Driven s(mecanum(), {}, "motion.point");
  s.command(0, 2, 0);
  s.run_for(0.99);
  EXPECT_NEAR(s.pose(s.robot).position.y(), 2, 1e-12);
}

std::string complaint(const RobotTree& tree, const Settings& settings = {}) {
  return test::complaint_of([&] { Driven s(tree, settings, ""); });
}

TEST(OmniDrive, WheelsThatCannotServeAreErrors) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(complaint(test::two_wheeler(0.05, 0.3)), "`bot` has 2 wheels, but three are needed");
  says(complaint(mecanum(0)), "the joint `bot/fl_joint` has the velocity limit 0");
  says(complaint(mecanum(), {{"roller_angle", std::vector<double>{0.5, 0.5, 0.5, 0.5}}}),
       "the wheels of `bot` do not hold it");
}

}  // namespace
}  // namespace muro
