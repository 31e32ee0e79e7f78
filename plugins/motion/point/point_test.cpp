// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

using Parameters_ = std::map<std::string, ParameterInput>;

struct Point : test::Scene {
  const RobotView& robot = add("point", test::single_body(Shape::sphere(0.1), {.mass = 1}));
  explicit Point(double rate, Parameters_ parameters = {}, const Pose& start = {}, const Twist& moving = {}) {
    world().set(robot.base(), keys::initial_pose, start);
    world().set(robot.base(), keys::initial_twist, moving);
    use("motion.point", rate, all_robots(), std::move(parameters));
    build();
  }
  Pose& at() { return pose(robot); }
  Twist& moving() { return twist(robot); }
  Twist& command() { return world().value(robot.base(), keys::command_twist); }
  Pose& goal() { return world().value(robot.base(), keys::command_pose); }
};

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 vector(double limit) { return {number(-limit, limit), number(-limit, limit), number(-limit, limit)}; }
  Quat turn() { return rotation_of(vector(1.5)); }

 private:
  std::mt19937 engine_;
};

/// Returns exp(t * xi) for the velocity xi of a body in its own axes, by the series of exp(t / 1024 * xi).
Eigen::Matrix4d screw(const Twist& xi, double t) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  const Vec3 &w = xi.angular, &v = xi.linear;
  m.topRows<3>() << 0, -w.z(), w.y(), v.x(), w.z(), 0, -w.x(), v.y(), -w.y(), w.x(), 0, v.z();
  const Eigen::Matrix4d part = m * (t / 1024);
  Eigen::Matrix4d whole = Eigen::Matrix4d::Identity(), term = whole;
  for (int i = 1; i <= 8; ++i) {
    term = term * part / i;
    whole += term;
  }
  for (int i = 0; i < 10; ++i) whole = whole * whole;
  return whole;
}

Eigen::Matrix4d matrix(const Pose& p) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = p.orientation.toRotationMatrix();
  m.topRightCorner<3, 1>() = p.position;
  return m;
}

TEST(PointMotion, AConstantCommandIsAScrewForAnyStepSize) {
  Draw draw(1);
  for (const double rate : {1.0, 10.0, 1000.0})
    for (int round = 0; round < 10; ++round) {
      const Pose start{draw.vector(3), draw.turn()};
      Point s(rate, {}, start);
      s.command() = {draw.vector(2), draw.vector(1.5)};
      s.run_for(3);
      const Eigen::Matrix4d expected = matrix(start) * screw(s.command(), 3);
      ASSERT_LT((matrix(s.at()) - expected).cwiseAbs().maxCoeff(), 1e-10)
          << "round " << round << " at " << rate << " Hz";
    }
}

TEST(PointMotion, TheBaseMovesInItsOwnAxesAsCommanded) {
  Draw draw(2);
  Point s(50, {}, {draw.vector(1), draw.turn()});
  for (int round = 0; round < 50; ++round) {
    s.command() = {draw.vector(2), draw.vector(3)};
    s.run_for(0.5);
    const Quat back = s.at().orientation.conjugate();
    ASSERT_LT((back * s.moving().linear - s.command().linear).norm(), 1e-13);
    ASSERT_LT((back * s.moving().angular - s.command().angular).norm(), 1e-13);
  }
}

TEST(PointMotion, SpeedsUpWithinItsLimitsAndKeepsTheDirectionOfTheCommand) {
  Point s(100, {{"max_speed", 0.5}, {"max_acceleration", 0.2}, {"max_turn_rate", 1.0}, {"max_turn_acceleration", 4.0}});
  s.command() = {{3, 4, 0}, {0, 0, 0}};
  s.run_for(1);
  EXPECT_LT((s.moving().linear - 0.2 * Vec3(0.6, 0.8, 0)).norm(), 1e-12);
  s.run_for(4);
  EXPECT_LT((s.moving().linear - 0.5 * Vec3(0.6, 0.8, 0)).norm(), 1e-12);
  s.command() = {{0, 0, 0}, {0, 0, -20}};
  s.run_for(0.125);
  EXPECT_NEAR(s.moving().angular.z(), -0.52, 1e-12) << "13 steps of 4 rad/s^2";
  s.run_for(1);
  EXPECT_NEAR(s.moving().angular.z(), -1, 1e-12);
  s.run_for(2);
  EXPECT_LT(s.moving().linear.norm(), 1e-12) << "slowed down to a halt";
}

TEST(PointMotion, StartsWithTheInitialTwist) {
  Point s(100, {{"max_acceleration", 1.0}, {"max_turn_acceleration", 1.0}}, {}, {{2, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(s.moving().linear, Vec3(2, 0, 0));
  s.run_for(1);
  EXPECT_NEAR(s.moving().linear.x(), 1, 1e-12);
}

TEST(PointMotion, ReachesAGoalInOneStepWhenNothingLimitsIt) {
  Draw draw(3);
  for (int round = 0; round < 20; ++round) {
    Point s(10, {{"mode", std::string("pose")}}, {draw.vector(1), draw.turn()});
    s.goal() = {draw.vector(5), draw.turn()};
    s.run_for(0.05);
    ASSERT_LT((s.at().position - s.goal().position).norm(), 1e-13);
    ASSERT_LT(s.at().orientation.angularDistance(s.goal().orientation), 1e-7);
    s.run_for(0.1);
    ASSERT_LT(s.moving().linear.norm() + s.moving().angular.norm(), 1e-6) << "and stays there";
  }
}

/// Values of one approach to a goal, recorded in each step.
struct Approach {
  double furthest_past = 0;  ///< m or rad beyond the goal
  double max_acceleration = 0;
  double max_speed = 0;
  double left = 0;  ///< m or rad, remaining distance at the end
};

Approach watch(Point& s, double period, int steps, bool turning) {
  const Vec3 way = s.goal().position - s.at().position;
  const Eigen::AngleAxisd turn(s.goal().orientation * s.at().orientation.conjugate());
  const Vec3 along = turning ? turn.axis() : Vec3(way.normalized());
  const double distance = turning ? turn.angle() : way.norm();
  const Vec3 start = s.at().position;
  const Quat first = s.at().orientation;
  Approach a;
  Vec3 before = Vec3::Zero();
  double gone = 0;
  for (int i = 0; i < steps; ++i) {
    s.run_for(period);
    const Vec3 v = turning ? s.moving().angular : s.moving().linear;
    const Eigen::AngleAxisd since(s.at().orientation * first.conjugate());
    gone = turning ? since.angle() * since.axis().dot(along) : (s.at().position - start).dot(along);
    a.furthest_past = std::max(a.furthest_past, gone - distance);
    a.max_acceleration = std::max(a.max_acceleration, (v - before).norm() / period);
    a.max_speed = std::max(a.max_speed, v.norm());
    before = v;
  }
  a.left = std::abs(distance - gone);
  return a;
}

TEST(PointMotion, BrakesBeforeTheGoalWithoutOvershootForAnyStepSize) {
  Draw draw(4);
  for (const double period : {0.5, 0.1, 0.02, 0.004})
    for (int round = 0; round < 10; ++round) {
      const double acceleration = draw.number(0.2, 3), speed = draw.number(0.3, 3);
      Point s(1 / period, {{"mode", std::string("pose")}, {"max_speed", speed}, {"max_acceleration", acceleration}},
              {draw.vector(2), draw.turn()});
      s.goal() = {s.at().position + draw.vector(2), s.at().orientation};
      const double way = (s.goal().position - s.at().position).norm();
      const double longest = way / speed + speed / acceleration + 2 * std::sqrt(way / acceleration) + 20 * period;
      const Approach a = watch(s, period, int(2 * longest / period), false);
      ASSERT_LT(a.furthest_past, 1e-9) << "period " << period << " round " << round;
      ASSERT_LT(a.max_acceleration, acceleration * (1 + 1e-9));
      ASSERT_LT(a.max_speed, speed * (1 + 1e-9));
      ASSERT_LT(a.left, 1e-9);
    }
}

TEST(PointMotion, BrakesATurnWithoutOvershoot) {
  Draw draw(5);
  for (const double period : {0.1, 0.01})
    for (int round = 0; round < 10; ++round) {
      const double acceleration = draw.number(0.2, 3), speed = draw.number(0.3, 3);
      Point s(1 / period,
              {{"mode", std::string("pose")}, {"max_turn_rate", speed}, {"max_turn_acceleration", acceleration}},
              {draw.vector(2), draw.turn()});
      s.goal() = {s.at().position, Quat(rotation_of(draw.vector(1.5)) * s.at().orientation)};
      const Approach a = watch(s, period, int((3 / speed + 10 / acceleration + 10) / period), true);
      ASSERT_LT(a.furthest_past, 1e-7) << "period " << period << " round " << round;
      ASSERT_LT(a.max_acceleration, acceleration * (1 + 1e-7));
      ASSERT_LT(a.max_speed, speed * (1 + 1e-9));
      ASSERT_LT(a.left, 1e-7);
    }
}

TEST(PointMotion, TheTimeToAGoalIsThatOfATrapezoidOfSpeed) {
  // 4 m with 1 m/s and 0.5 m/s^2: 2 s and 1 m each to speed up and to brake, 2 s at full speed
  Point s(1000, {{"mode", std::string("pose")}, {"max_speed", 1.0}, {"max_acceleration", 0.5}});
  s.goal().position = {4, 0, 0};
  s.run_for(3);
  EXPECT_NEAR(s.at().position.x(), 2, 2e-3);
  s.run_for(2.9);
  EXPECT_NEAR(s.at().position.x(), 4 - 0.25 * 0.1 * 0.1, 2e-3);
  s.run_for(0.2);
  EXPECT_NEAR(s.at().position.x(), 4, 1e-4);
}

TEST(PointMotion, TravelsStraightToTheGoalWhileItTurns) {
  Point s(100, {{"mode", std::string("pose")}, {"max_turn_rate", 1.0}, {"max_speed", 1.0}});
  s.goal() = {{2, 0, 0}, from_rpy(0, 0, 3)};
  s.run_for(1);
  EXPECT_NEAR(s.at().position.x(), 1, 1e-12);
  EXPECT_EQ(s.at().position.y(), 0);
  EXPECT_NEAR(yaw_of(s.at().orientation), 1, 1e-12);
}

TEST(PointMotion, WithoutAccelerationItStaysWhereItIs) {
  Point s(100, {{"mode", std::string("pose")}, {"max_acceleration", 0.0}, {"max_turn_acceleration", 0.0}});
  s.goal() = {{2, 0, 0}, from_rpy(0, 0, 1)};
  s.run_for(1);
  EXPECT_EQ(s.at().position, Vec3::Zero());
  EXPECT_EQ(s.moving().linear, Vec3::Zero());
}

/// A robot with one joint; the test writes its target like control code.
struct Jointed : test::Scene {
  const RobotView* robot;
  Out<double> target;

  Jointed(const Key<double>& written, const std::string& mode) {
    robot = &add("r", test::tree_of([](RobotBuilder& b) {
                   b.base("base");
                   b.revolute("joint", Vec3::UnitZ(), {.lower = -1, .upper = 1, .velocity = 0.5});
                   b.body("link");
                 }));
    use("motion.point", 100, all_robots(), {{"joints", mode}});
    PropertyStore& store = world().store();
    target = Out<double>(store.bind(store.add_accessor("control"), world().object("r/joint"), written,
                                    usage::optional_output, Multiplicity::single, 1, nullptr));
    build();
  }
  double joint() { return world().value("r/joint", keys::joint_position); }
};

TEST(PointMotion, JointsFollowTheTargetsThatSomethingWrites) {
  Jointed by_position(keys::joint_position_target, "auto");
  *by_position.target = 0.2;
  by_position.run_for(2);
  EXPECT_EQ(by_position.joint(), 0.2);
  EXPECT_EQ(by_position.world().value("r/joint", keys::joint_velocity), 0) << "it has arrived";
  Jointed by_velocity(keys::joint_velocity_target, "auto");
  *by_velocity.target = 0.2;
  by_velocity.run_for(2);
  EXPECT_NEAR(by_velocity.joint(), 0.4, 1e-12);
  Jointed still(keys::joint_effort_target, "passive");
  EXPECT_EQ(still.world().store().find(still.world().object("r/joint"), keys::joint_position.name), nullptr)
      << "left to others";
}

TEST(PointMotion, AJointBeyondItsLimitMayComeBackAndGoesNoFurther) {
  for (const double v : {0.5, -0.5}) {
    Jointed s(keys::joint_velocity_target, "velocity");
    s.world().value("r/joint", keys::joint_position) = 1.2;
    *s.target = v;
    s.run_for(0.2);
    EXPECT_NEAR(s.joint(), v > 0 ? 1.2 : 1.1, 1e-12);
  }
}

TEST(PointMotion, ATargetThatIsNotFiniteIsAnErrorWithTheJointsName) {
  Jointed s(keys::joint_position_target, "auto");
  *s.target = std::nan("");
  EXPECT_SAYS(test::complaint_of<StepError>([&] { s.run_for(0.1); }), "the target of `r/joint` is not finite");
}

TEST(PointMotion, ACommandThatIsNotFiniteIsAnErrorWithTheRobotsName) {
  Point s(100);
  s.command().linear.x() = std::nan("");
  try {
    s.run_for(1);
    FAIL() << "went on with a command of nan";
  } catch (const StepError& e) {
    EXPECT_NE(std::string(e.what()).find("the command of `point` is not finite"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace muro
