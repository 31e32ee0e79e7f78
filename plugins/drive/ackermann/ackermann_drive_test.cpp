// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using Settings = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;

struct WheelSpec {
  std::string name;
  Vec3 at;
  bool steered = false;
  double limit = 0.6;  ///< rad
  Vec3 arm = Vec3::Zero();
  double radius = 0.1;
  double wheel_speed = 1e3;
  std::string leader{};
  bool endless = false;
};

RobotTree vehicle_of(const std::vector<WheelSpec>& wheels) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    for (const WheelSpec& p : wheels) {
      const Shape tyre = test::tyre(p.radius);
      b.fork();
      b.translation(p.at);
      if (p.steered) {
        JointLimits limits;
        if (!p.endless) limits.lower = -p.limit, limits.upper = p.limit;
        b.revolute(p.name + "_steering", Vec3::UnitZ(), limits);
        if (!p.leader.empty()) b.mimic(p.leader, 1, 0);
        b.body(p.name + "_knuckle");
        b.translation(p.arm);
      }
      b.revolute(p.name + "_wheel", Vec3::UnitY(), {.velocity = p.wheel_speed});
      b.body(p.name + "_tyre");
      b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
      b.end();
    }
    for (std::size_t i = 0; i < wheels.size(); ++i) b.end();
  });
}

/// Wheelbase 2 m, track 1 m, the base in the middle of the rear axle.
std::vector<WheelSpec> car(double limit = 0.6) {
  return {{.name = "rl", .at = {0, 0.5, 0}},
          {.name = "rr", .at = {0, -0.5, 0}},
          {.name = "fl", .at = {2, 0.5, 0}, .steered = true, .limit = limit},
          {.name = "fr", .at = {2, -0.5, 0}, .steered = true, .limit = limit}};
}

/// A vehicle with a drive and, unless `motion` is empty, a motion, both at 100 Hz.
struct Driven : test::Scene {
  const RobotView& robot;
  explicit Driven(const RobotTree& tree, Settings settings = {}, const std::string& motion = "motion.ackermann")
      : robot(add("car", tree)) {
    Settings names;
    for (const char* name : {"steering", "driven", "rolling"})
      if (settings.count(name) > 0) names[name] = settings[name];
    if (!motion.empty()) use(motion, 100, all_robots(), names);
    use("drive.ackermann", 100, all_robots(), std::move(settings));
    build();
  }
  explicit Driven(const std::vector<WheelSpec>& wheels, Settings settings = {},
                  const std::string& motion = "motion.ackermann")
      : Driven(vehicle_of(wheels), std::move(settings), motion) {}
  void command(double x, double y, double turn) {
    world().value(robot.base(), keys::command_twist) = {{x, y, 0}, {0, 0, turn}};
    run_for(0.01);
  }
  void command(double x, double turn) { command(x, 0, turn); }
  double angle(const std::string& wheel) {
    return world().value("car/" + wheel + "_steering", keys::joint_position_target);
  }
  double speed(const std::string& wheel) {
    return world().value("car/" + wheel + "_wheel", keys::joint_velocity_target);
  }
  Vec3 moving() { return pose(robot).orientation.conjugate() * twist(robot).linear; }
  double turning() { return twist(robot).angular.z(); }
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

TEST(AckermannDrive, GivesEachWheelTheAngleAndSpeedOfItsOwnCircle) {
  Driven s(car());
  s.command(2, 0.4);  // radius 5 m
  EXPECT_NEAR(s.angle("fl"), std::atan(2 / 4.5), 1e-14);
  EXPECT_NEAR(s.angle("fr"), std::atan(2 / 5.5), 1e-14);
  EXPECT_NEAR(s.speed("rl"), 0.4 * 4.5 / 0.1, 1e-13);
  EXPECT_NEAR(s.speed("rr"), 0.4 * 5.5 / 0.1, 1e-13);
  EXPECT_NEAR(1 / std::tan(s.angle("fr")) - 1 / std::tan(s.angle("fl")), 1 / 2.0, 1e-13) << "track by wheelbase";
}

TEST(AckermannDrive, MovesTheBaseAsCommandedWhateverTheWheelsAre) {
  Draw draw{std::mt19937(1)};
  for (int round = 0; round < 40; ++round) {
    const double axle = draw(-1, 1), side = draw(-1, 1) < 0 ? -1 : 1;
    std::vector<WheelSpec> wheels = {{.name = "a", .at = {axle, draw(0.1, 0.5), 0}},
                                     {.name = "b", .at = {axle, draw(-0.5, 0), 0}}};
    for (const char* name : {"c", "d", "e"})
      wheels.push_back({.name = name,
                        .at = {axle + side * draw(1, 2), draw(-0.5, 0.5), 0},
                        .steered = true,
                        .limit = 1.3,
                        .arm = {draw(-0.1, 0.1), draw(-0.1, 0.1), 0}});
    for (WheelSpec& p : wheels) p.radius = draw(0.05, 0.3);
    Settings all_driven;
    if (round % 2 == 0) all_driven["driven"] = Names{"a_wheel", "b_wheel", "c_wheel", "d_wheel", "e_wheel"};
    Driven s(wheels, all_driven);
    const double v = (draw(-1, 1) < 0 ? -1 : 1) * draw(0.5, 2), turn = v * draw(-0.3, 0.3);
    s.command(v, turn);
    EXPECT_NEAR(s.moving().x(), v, 1e-12);
    EXPECT_NEAR(s.moving().y(), -axle * turn, 1e-12) << "the base swings beside the axle";
    EXPECT_NEAR(s.turning(), turn, 1e-12);
  }
}

TEST(AckermannDrive, BackwardsItSteersTheSameWay) {
  Driven s(car());
  s.command(-2, -0.4);
  EXPECT_NEAR(s.angle("fl"), std::atan(2 / 4.5), 1e-14);
  EXPECT_NEAR(s.speed("rr"), -22, 1e-12);
}

TEST(AckermannDrive, AtTheSteeringLimitItKeepsTheSpeedAndTurnsLess) {
  Driven s(car(0.5));
  const double radius = 0.5 + 2 / std::tan(0.5);  // the inner wheel stands at its limit
  for (const double side : {1.0, -1.0}) {
    s.command(1, 5 * side);
    EXPECT_NEAR(s.angle(side > 0 ? "fl" : "fr"), 0.5 * side, 1e-14);
    EXPECT_NEAR(s.angle(side > 0 ? "fr" : "fl"), side * std::atan(2 / (radius + 0.5)), 1e-14);
    EXPECT_NEAR(s.moving().x(), 1, 1e-13);
    EXPECT_NEAR(s.turning(), side / radius, 1e-13);
  }
  Driven narrow(car(0.5), {{"max_steering_angle", 0.2}});
  narrow.command(1, 5);
  EXPECT_NEAR(narrow.turning(), 1 / (0.5 + 2 / std::tan(0.2)), 1e-13);
}

TEST(AckermannDrive, ALimitOfOneWheelAloneIsKeptByAll) {
  std::vector<WheelSpec> wheels = car(1.2);
  wheels[3].limit = 0.3;  // the outer wheel of a left turn
  Driven s(wheels);
  s.command(1, 2);
  EXPECT_NEAR(s.angle("fr"), 0.3, 1e-14);
  EXPECT_NEAR(s.turning(), 1 / (2 / std::tan(0.3) - 0.5), 1e-13);
}

TEST(AckermannDrive, SlowsAllWheelsAlikeWhenOneIsAtItsLimit) {
  std::vector<WheelSpec> wheels = car();
  wheels[1].wheel_speed = 11;
  for (const double limit : {1e9, 5.5}) {
    Driven s(wheels, {{"max_wheel_speed", limit}});
    s.command(2, 0.4);  // wants 18 and 22 rad/s
    const double max_speed = std::min(11.0, limit);
    EXPECT_NEAR(s.speed("rr"), max_speed, 1e-12);
    EXPECT_NEAR(s.turning() / s.moving().x(), 0.2, 1e-13);
  }
}

TEST(AckermannDrive, ACarThatIsToTurnWithoutMovingStandsWithItsWheelsTurned) {
  Driven s(car(0.5));
  s.command(0, -3);
  EXPECT_EQ(s.speed("rl"), 0);
  EXPECT_EQ(s.speed("rr"), 0);
  EXPECT_NEAR(s.angle("fr"), -0.5, 1e-8);
  EXPECT_NEAR(s.angle("fl"), -std::atan(2 / (2 / std::tan(0.5) + 1)), 1e-8);
  EXPECT_EQ(s.twist(s.robot).linear.norm() + s.turning(), 0);
}

TEST(AckermannDrive, ATricycleThatCanTurnsOnTheSpot) {
  const std::vector<WheelSpec> wheels = {{.name = "f", .at = {1, 0, 0}, .steered = true, .limit = 1.6},
                                         {.name = "l", .at = {0, 0.3, 0}},
                                         {.name = "r", .at = {0, -0.3, 0}}};
  Driven s(wheels, {{"driven", Names{"f_wheel"}}});
  s.command(0, 0.5);
  EXPECT_NEAR(s.angle("f"), M_PI / 2, 1e-14);
  EXPECT_NEAR(s.turning(), 0.5, 1e-14);
  EXPECT_NEAR(s.moving().norm(), 0, 1e-14);
}

TEST(AckermannDrive, AtRestTheSteeringStaysAsItWas) {
  Driven s(car());
  s.command(2, 0.4);
  const double angle = s.angle("fl");
  s.command(0, 0);
  EXPECT_EQ(s.angle("fl"), angle);
  EXPECT_EQ(s.speed("rl"), 0);
  s.command(1, 0);
  EXPECT_EQ(s.angle("fl"), 0);
}

std::vector<WheelSpec> all_steered(double limit) {
  std::vector<WheelSpec> wheels = car(limit);
  for (WheelSpec& p : wheels) p.at.x() -= 1, p.steered = true, p.limit = limit;
  return wheels;
}

TEST(AckermannDrive, WithAllWheelsSteeredItMovesSidewaysToo) {
  Draw draw{std::mt19937(2)};
  for (const bool endless : {false, true}) {
    std::vector<WheelSpec> wheels = all_steered(1.58);
    Settings names;
    for (WheelSpec& p : wheels) p.endless = endless;
    if (endless) names["steering"] = Names{"rl_steering", "rr_steering", "fl_steering", "fr_steering"};
    Driven s(wheels, names);
    for (int round = 0; round < 20; ++round) {
      const double x = draw(0.2, 2), y = draw(-1, 1), turn = endless ? draw(-3, 3) : draw(-0.1, 0.1);
      s.command(x, y, turn);
      EXPECT_NEAR(s.moving().x(), x, 1e-12);
      EXPECT_NEAR(s.moving().y(), y, 1e-12);
      EXPECT_NEAR(s.turning(), turn, 1e-12);
    }
    s.command(0, 0.7, 0);
    EXPECT_NEAR(s.moving().y(), 0.7, 1e-13);
  }
  Driven limited(all_steered(0.5));
  limited.command(1, 3, 0);
  EXPECT_NEAR(limited.angle("rl"), 0.5, 1e-14);
  EXPECT_NEAR(limited.moving().x(), 1, 1e-13);
  EXPECT_NEAR(limited.moving().y(), std::tan(0.5), 1e-13) << "as far to the side as it can";
  limited.command(0, 3, 0);
  EXPECT_EQ(limited.speed("fl"), 0);
  limited.command(1, 3);
  EXPECT_NEAR(limited.turning(), 1 / (0.5 + 1 / std::tan(0.5)), 1e-13) << "about a point beside its middle";
}

TEST(AckermannDrive, OneJointMaySteerSeveralWheels) {
  std::vector<WheelSpec> wheels = car();
  wheels[3].leader = "fl_steering";
  Driven s(wheels);
  s.command(2, 0.4);
  EXPECT_NEAR(s.angle("fl"), 0.5 * (std::atan(2 / 4.5) + std::atan(2 / 5.5)), 1e-14) << "the mean of what both need";
  EXPECT_NEAR(s.turning(), 0.4, 0.004) << "parallel wheels are no Ackermann linkage";
}

TEST(AckermannDrive, IsNoErrorOnALevelWithoutWheels) {
  Driven s(car(), {}, "motion.point");
  s.command(2, 0);
  s.run_for(0.99);
  EXPECT_NEAR(s.pose(s.robot).position.x(), 2, 1e-12);
}

TEST(AckermannDrive, DrivesTheCarOfTheExamplesAroundACircle) {
  test::Scene reader;
  Driven s(reader.read_model(MURO_TEST_SOURCE_DIR "/examples/models/car.urdf"));
  s.command(1, 0.8);
  s.run_for(2);
  EXPECT_NEAR(s.moving().x(), 1, 1e-12);
  EXPECT_NEAR(s.turning(), 0.8, 1e-12);
  s.command(1, 9);
  s.run_for(1);
  EXPECT_NEAR(s.turning(), 1 / (0.098 + 0.33 / std::tan(0.5)), 1e-12) << "its turning circle";
}

TEST(AckermannDrive, AVehicleWithoutSteeredWheelsIsAnError) {
  try {
    Driven s(test::two_wheeler(0.05, 0.3), {}, "");
    FAIL() << "took a vehicle without steering";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("has no steered wheels"), std::string::npos) << e.what();
  }
}

TEST(AckermannDrive, AWheelThatMayNotTurnIsAnError) {
  std::vector<WheelSpec> wheels = car();
  wheels[0].wheel_speed = 0;
  try {
    Driven s(wheels);
    FAIL() << "a wheel without speed was taken";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("the joint `car/rl_wheel` has the velocity limit 0"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace muro
