// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "core/instance.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using test::WheelPart;
using Settings = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;
using Reals = std::vector<double>;

constexpr double lx = 0.25, ly = 0.2, r = 0.05;

std::vector<WheelPart> mecanum_wheels() {
  return {{.name = "fl", .at = {lx, ly, r}},
          {.name = "fr", .at = {lx, -ly, r}},
          {.name = "rl", .at = {-lx, ly, r}},
          {.name = "rr", .at = {-lx, -ly, r}}};
}

/// Returns wheels at these angles, `arm` (m) from the middle, with axes that point inward.
std::vector<WheelPart> omni_wheels(const std::vector<double>& angles, double arm) {
  std::vector<WheelPart> wheels;
  for (const double a : angles) {
    const Vec3 out(std::cos(a), std::sin(a), 0);
    WheelPart w{.name = "w" + std::to_string(wheels.size()), .at = arm * out, .axis = -out, .own_shape = true};
    w.shape = Shape::cylinder(r, 0.03);
    w.shape.origin.orientation = from_rpy(0, M_PI / 2, a);
    wheels.push_back(w);
  }
  return wheels;
}
std::vector<WheelPart> kiwi_wheels() { return omni_wheels({M_PI / 3, M_PI, -M_PI / 3}, 0.2); }

struct Vehicle : test::Scene {
  const RobotView& robot;
  Vehicle(double rate, const RobotTree& tree, Settings settings = {}, const Pose& start = {}, const Twist& moving = {})
      : robot(add("bot", tree, start, moving)) {
    use("motion.omni", rate, all_robots(), std::move(settings));
    build();
  }
  Vehicle(double rate, const std::vector<WheelPart>& wheels, Settings settings = {}, const Pose& start = {},
          const Twist& moving = {})
      : Vehicle(rate, test::wheeled_robot(wheels), std::move(settings), start, moving) {}
  double& value(const std::string& wheel, const Key<double>& key) {
    return world().value("bot/" + wheel + "_joint", key);
  }
  void turn(const std::string& wheel, double speed) { value(wheel, keys::joint_velocity_target) = speed; }
  Pose& at() { return pose(robot); }
  Vec3 moving() { return pose(robot).orientation.conjugate() * twist(robot).linear; }
  double turning() { return twist(robot).angular.z(); }
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

/// Returns the end of a path with a constant velocity in the base's axes.
Vec3 arc_end(double x, double y, double turn, double t) {
  const double s = std::sin(turn * t) / turn, c = (1 - std::cos(turn * t)) / turn;
  return {s * x - c * y, c * x + s * y, 0};
}

TEST(Omni, MecanumWheelsMoveItByTheTextbookFormula) {
  for (const double rate : {0.1, 1.0, 1000.0}) {
    Vehicle s(rate, mecanum_wheels());
    const double x = 0.3, y = -0.2, turn = 0.7, k = lx + ly;
    s.turn("fl", (x - y - k * turn) / r);
    s.turn("fr", (x + y + k * turn) / r);
    s.turn("rl", (x + y - k * turn) / r);
    s.turn("rr", (x - y + k * turn) / r);
    s.run_for(10);
    EXPECT_LT((s.moving() - Vec3(x, y, 0)).norm(), 1e-12) << rate << " Hz";
    EXPECT_NEAR(s.turning(), turn, 1e-12);
    EXPECT_LT((s.at().position - arc_end(x, y, turn, 10)).norm(), 1e-12) << "an exact arc at " << rate << " Hz";
    EXPECT_NEAR(std::remainder(yaw_of(s.at().orientation) - 7, 2 * M_PI), 0, 1e-11);
    EXPECT_NEAR(s.value("fl", keys::joint_position), 10 * (x - y - k * turn) / r, 1e-10);
  }
}

TEST(Omni, ThreeOmniWheelsMoveItByTheFormulaOfTheKiwiDrive) {
  for (const double rate : {0.1, 1000.0}) {
    Vehicle s(rate, kiwi_wheels());
    const double x = 0.3, y = -0.2, turn = 0.7;
    const double angles[] = {M_PI / 3, M_PI, -M_PI / 3};
    for (int i = 0; i < 3; ++i)
      s.turn("w" + std::to_string(i), (-std::sin(angles[i]) * x + std::cos(angles[i]) * y + 0.2 * turn) / r);
    s.run_for(10);
    EXPECT_LT((s.moving() - Vec3(x, y, 0)).norm(), 1e-12);
    EXPECT_NEAR(s.turning(), turn, 1e-12);
    EXPECT_LT((s.at().position - arc_end(x, y, turn, 10)).norm(), 1e-12);
  }
}

TEST(Omni, AxesMayPointEitherWay) {
  std::vector<WheelPart> kiwi = kiwi_wheels(), mecanum = mecanum_wheels();
  for (WheelPart& w : kiwi) w.axis = -w.axis;
  for (WheelPart& w : mecanum) w.axis = -w.axis;
  Vehicle a(10, kiwi), b(10, mecanum);
  for (const char* w : {"w0", "w1", "w2"}) a.turn(w, -3);
  for (const char* w : {"fl", "fr", "rl", "rr"}) b.turn(w, -3);
  a.run_for(1), b.run_for(1);
  EXPECT_NEAR(a.turning(), 3 * r / 0.2, 1e-13) << "about its middle";
  EXPECT_NEAR(b.moving().x(), 3 * r, 1e-13);
}

TEST(Omni, RollerAnglesCanBeGiven) {
  const double x = 0.3, y = 0.4, turn = -0.5;
  const auto expect = [&](Vehicle& s, const std::vector<double>& angles) {
    const Vec3 at[] = {{lx, ly, 0}, {lx, -ly, 0}, {-lx, ly, 0}, {-lx, -ly, 0}};
    const char* names[] = {"fl", "fr", "rl", "rr"};
    for (int i = 0; i < 4; ++i)
      s.turn(names[i], (x - turn * at[i].y() + std::tan(angles[std::size_t(i)]) * (y + turn * at[i].x())) / r);
    s.run_for(1);
    EXPECT_LT((s.moving() - Vec3(x, y, 0)).norm(), 1e-12);
    EXPECT_NEAR(s.turning(), turn, 1e-12);
  };
  Vehicle steep(10, mecanum_wheels(), {{"roller_angle", Reals{1.0}}});
  expect(steep, {-1, 1, 1, -1});
  Vehicle mirrored(10, mecanum_wheels(), {{"roller_angle", Reals{0.6, -0.6, -0.6, 0.6}}});
  expect(mirrored, {0.6, -0.6, -0.6, 0.6});
  Vehicle ordered(10, mecanum_wheels(),
                  {{"wheels", Names{"rr_joint", "fl_joint", "fr_joint", "rl_joint"}},
                   {"roller_angle", Reals{-0.7, -0.6, 0.8, 0.9}}});
  expect(ordered, {-0.6, 0.8, 0.9, -0.7});
}

TEST(Omni, FourOmniWheelsWhoseSpeedsDisagreeMoveItByLeastSquares) {
  Vehicle s(10, omni_wheels({0, M_PI / 2, M_PI, -M_PI / 2}, 0.2));
  s.turn("w0", 2);  // forward is to the left there
  s.run_for(1);
  EXPECT_NEAR(s.moving().y(), 0.5 * 2 * r, 1e-14) << "the mean of the wheels in front and behind";
  EXPECT_NEAR(s.moving().x(), 0, 1e-14);
  EXPECT_NEAR(s.turning(), 0.25 * 2 * r / 0.2, 1e-14) << "the mean of all";
}

TEST(Omni, AGradualStartIsExactForAnyStepSize) {
  Vec3 end[3];
  const double rates[] = {0.5, 10, 1000};
  for (int i = 0; i < 3; ++i) {
    Vehicle s(rates[i], kiwi_wheels(), {{"max_wheel_acceleration", 2.0}});
    s.turn("w0", 3), s.turn("w1", -1), s.turn("w2", 2);
    s.run_for(4);
    end[i] = s.at().position;
    EXPECT_NEAR(s.value("w0", keys::joint_position), 0.5 * 3 * 1.5 + 3 * 2.5, 1e-12);
  }
  EXPECT_LT((end[0] - end[2]).norm(), 1e-10);
  EXPECT_LT((end[1] - end[2]).norm(), 1e-10);
}

TEST(Omni, StartsAndTakesOverAtTheSpeedOfTheBase) {
  const Pose start{{1, 2, 0}, from_rpy(0, 0, 0.7)};
  const Vec3 velocity = start.orientation * Vec3(0.3, -0.2, 0);
  Vehicle s(10, mecanum_wheels(), {{"max_wheel_acceleration", 1.0}}, start, {velocity, {0, 0, 0.7}});
  EXPECT_NEAR(s.value("fl", keys::joint_velocity), (0.3 + 0.2 - (lx + ly) * 0.7) / r, 1e-12);
  EXPECT_LT((s.twist(s.robot).linear - velocity).norm(), 1e-14);
  s.run_for(0.5);
  s.twist(s.robot) = {s.at().orientation * Vec3(0.1, 0.4, 9), {0, 0, -0.2}};
  abi::ErrorText error;
  ASSERT_TRUE(s.instances()[0]->on_handover(0, error)) << error.view();
  EXPECT_NEAR(s.value("rl", keys::joint_velocity), (0.1 + 0.4 + (lx + ly) * 0.2) / r, 1e-12);
}

TEST(Omni, KeepsTheLimitsOfItsWheels) {
  std::vector<WheelPart> wheels = mecanum_wheels();
  for (WheelPart& w : wheels) w.limits.velocity = 5;
  Vehicle s(100, wheels, {{"max_wheel_acceleration", 2.0}});
  for (const WheelPart& w : wheels) s.turn(w.name, 100);
  s.run_for(1);
  EXPECT_NEAR(s.moving().x(), 2 * r, 1e-13);
  s.run_for(4);
  EXPECT_NEAR(s.moving().x(), 5 * r, 1e-13);
}

TEST(Omni, RollersOfTheModelAreNoWheels) {
  const auto rollers = [](RobotBuilder& b) {
    const Shape roller = test::tyre(0.01);
    b.revolute("hub_joint", Vec3::UnitY(), {});
    b.body("hub");
    b.translation({0, 0, 0.05});
    b.revolute("roller_joint", Vec3::UnitX(), {});
    b.body("roller");
    b.set_array(keys::collision_shapes, std::span<const Shape>(&roller, 1));
  };
  Vehicle s(10, test::wheeled_robot(mecanum_wheels(), rollers));
  for (const char* w : {"fl", "fr", "rl", "rr"}) s.turn(w, 4);
  s.run_for(1);
  EXPECT_NEAR(s.moving().x(), 4 * r, 1e-13);
}

TEST(Omni, GoesOnFromASnapshotToTheSameBits) {
  Vehicle s(100, kiwi_wheels(), {{"max_wheel_acceleration", 0.7}});
  s.turn("w0", 3), s.turn("w1", -1), s.turn("w2", 2);
  s.run_for(0.537);
  const Snapshot snapshot = s.snapshot();
  s.run_for(1);
  const std::uint64_t end = s.state_hash();
  s.restore(snapshot);
  s.run_for(1);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(Omni, DrivesTheModelsOfTheExamples) {
  test::Scene reader;
  const std::string models = MURO_TEST_SOURCE_DIR "/examples/models/";
  Vehicle mecanum(10, reader.read_model(models + "mecanum.urdf")), kiwi(10, reader.read_model(models + "kiwi.urdf"));
  const auto turn = [](Vehicle& s, const std::string& wheel, double speed) { s.turn(wheel + "_wheel", speed); };
  turn(mecanum, "front_left", -4), turn(mecanum, "front_right", 4);
  turn(mecanum, "rear_left", 4), turn(mecanum, "rear_right", -4);
  for (const char* wheel : {"left", "rear", "right"}) turn(kiwi, wheel, 2);
  mecanum.run_for(1), kiwi.run_for(1);
  EXPECT_LT((mecanum.moving() - Vec3(0, 4 * 0.0475, 0)).norm(), 1e-12) << "to the left";
  EXPECT_NEAR(mecanum.turning(), 0, 1e-12);
  EXPECT_LT(kiwi.moving().norm(), 1e-12);
  EXPECT_NEAR(kiwi.turning(), 2 * 0.04 / 0.135, 1e-12);
}

std::string complaint(const RobotTree& tree, const Settings& settings = {}) {
  return test::complaint_of([&] { Vehicle s(10, tree, settings); });
}

TEST(Omni, FewerThanThreeWheelsAreAnErrorThatTellsWhatTheModelHas) {
  std::vector<WheelPart> two = mecanum_wheels();
  two.resize(2);
  two.push_back({.name = "limited", .limits = {.lower = -1, .upper = 1}});
  EXPECT_SAYS(
      complaint(test::wheeled_robot(two)),
      "`bot` has 2 wheels, but three are needed to move in every direction: `fl_joint` is a wheel; `fr_joint` is "
      "a wheel; 1 joint has limits of position. Name the wheels' joints with `wheels`");
}

TEST(Omni, WheelsWithoutKnownRollersAreAnError) {
  std::vector<WheelPart> six = mecanum_wheels();
  six.push_back({.name = "ml", .at = {0, ly, r}});
  six.push_back({.name = "mr", .at = {0, -ly, r}});
  EXPECT_SAYS(complaint(test::wheeled_robot(six)), "what rollers its wheels have cannot be told");
  EXPECT_EQ(complaint(test::wheeled_robot(six), {{"roller_angle", Reals{-0.7, 0.7, 0.7, -0.7, 0.7, -0.7}}}),
            "no complaint");
}

TEST(Omni, RollersThatLeaveAMotionFreeAreAnError) {
  const RobotTree tree = test::wheeled_robot(mecanum_wheels());
  EXPECT_SAYS(complaint(tree, {{"roller_angle", Reals{0.7, 0.7, 0.7, 0.7}}}),
              "the wheels of `bot` do not hold it: with all of them at rest it can still move");
  EXPECT_SAYS(complaint(tree, {{"roller_angle", Reals{0.7, 0.7}}}), "`roller_angle` has 2 values for 4 wheels");
  EXPECT_SAYS(complaint(tree, {{"roller_angle", Reals{1.57}}}), "give an angle between -1.5 and 1.5");
  EXPECT_SAYS(complaint(tree, {{"wheels", Names{"fl_joint", "fl_joint"}}}), "`wheels` names `fl_joint` twice");
}

TEST(Omni, AWheelThatIsToTurnAtNoFiniteSpeedIsAnError) {
  Vehicle s(100, kiwi_wheels());
  s.turn("w1", std::nan(""));
  try {
    s.run_for(1);
    FAIL() << "went on with a target of nan";
  } catch (const StepError& e) {
    EXPECT_SAYS(std::string(e.what()), "a wheel of `bot` is to turn at a speed that is not finite");
  }
}

}  // namespace
}  // namespace muro
