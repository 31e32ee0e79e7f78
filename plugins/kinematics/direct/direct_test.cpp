// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

/// Returns a pan-tilt head on a mast, a gripper with two fingers (the first one follows the second), and a bumper.
RobotTree head() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("base");
    b.fork();
    b.translation({0.1, 0, 0.5});
    b.body("mast");
    b.translation({0, 0, 0.2});
    b.revolute("pan", Vec3::UnitZ(), {});
    b.body("head");
    b.rotation(from_rpy(0.3, 0, 0));
    b.revolute("tilt", Vec3::UnitY(), {});
    b.set(keys::initial_joint_position, 0.25);
    b.body("camera");
    b.end();
    b.fork();
    b.translation({0.3, 0, 0});
    b.body("bumper");
    b.end();
    b.fork();
    b.prismatic("follower", Vec3::UnitY(), {});
    b.mimic("leader", -2, 0.01);
    b.body("first_finger");
    b.end();
    b.prismatic("leader", Vec3::UnitY(), {});
    b.set(keys::initial_joint_position, 0.02);
    b.body("second_finger");
    b.end();
    b.end();
    b.end();
  });
}

struct Heads : test::Scene {
  explicit Heads(const std::vector<Pose>& starts) {
    for (std::size_t i = 0; i < starts.size(); ++i) add("head_" + std::to_string(i), head(), starts[i]);
    // the motion moves bases at t = 0; kinematics at 0.01 s uses the result
    use("motion.point", 1, all_robots(), {{"joints", "passive"}});
    use("kinematics.direct", 100, all_robots());
    build();
  }
  void settle() { run_for(0.015); }
  Pose pose_of(int robot, const std::string& body) {
    return world().value("head_" + std::to_string(robot) + "/" + body, keys::pose);
  }
  Twist twist_of(int robot, const std::string& body) {
    return world().value("head_" + std::to_string(robot) + "/" + body, keys::twist);
  }
  double& joint(int robot, const std::string& name, const Key<double>& key) {
    return world().value("head_" + std::to_string(robot) + "/" + name, key);
  }
};

void expect_near(const Pose& a, const Pose& b, double tolerance) {
  EXPECT_LT((a.position - b.position).norm(), tolerance);
  EXPECT_LT(a.orientation.angularDistance(b.orientation), tolerance);
}

Pose rotation(const Vec3& axis, double angle) { return {Vec3::Zero(), Quat(Eigen::AngleAxisd(angle, axis))}; }

TEST(DirectKinematics, PutsUnmovedJointsAtTheirInitialPosition) {
  Heads s({{{1, 2, 3}, from_rpy(0.1, 0.2, 0.3)}});
  s.settle();
  const Pose base = s.pose_of(0, "base");
  expect_near(s.pose_of(0, "bumper"), base * Pose{{0.3, 0, 0}, Quat::Identity()}, 1e-15);
  expect_near(
      s.pose_of(0, "camera"),
      base * Pose{{0.1, 0, 0.7}, Quat::Identity()} * rotation(Vec3::UnitX(), 0.3) * rotation(Vec3::UnitY(), 0.25),
      1e-14);
  expect_near(s.pose_of(0, "second_finger"), base * Pose{{0, 0.02, 0}, Quat::Identity()}, 1e-15);
}

TEST(DirectKinematics, FollowsJointsThatAreSetFromOutside) {
  Heads s({Pose{}, Pose{{5, 0, 0}, Quat::Identity()}});
  s.joint(1, "pan", keys::joint_position) = 0.5;
  s.joint(1, "pan", keys::joint_velocity) = 2;
  s.settle();
  expect_near(s.pose_of(0, "head"), {{0.1, 0, 0.7}, Quat::Identity()}, 1e-15);
  expect_near(s.pose_of(1, "head"), Pose{{5.1, 0, 0.7}, Quat::Identity()} * rotation(Vec3::UnitZ(), 0.5), 1e-14);
  EXPECT_LT((s.twist_of(1, "camera").angular - Vec3(0, 0, 2)).norm(), 1e-15);
  EXPECT_EQ(s.twist_of(0, "camera").angular, Vec3::Zero());
}

TEST(DirectKinematics, MovesAMimicJointAfterItsLeaderThatComesLaterInTheTree) {
  Heads s({Pose{}});
  s.joint(0, "leader", keys::joint_position) = 0.03;
  s.joint(0, "leader", keys::joint_velocity) = 0.5;
  s.settle();
  EXPECT_DOUBLE_EQ(s.pose_of(0, "first_finger").position.y(), 0.01 - 2 * 0.03);
  EXPECT_DOUBLE_EQ(s.twist_of(0, "first_finger").linear.y(), -1);
  EXPECT_DOUBLE_EQ(s.joint(0, "follower", keys::joint_position), 0.01 - 2 * 0.03);
  EXPECT_DOUBLE_EQ(s.joint(0, "follower", keys::joint_velocity), -1);
}

TEST(DirectKinematics, BodiesMoveWithABaseThatTurns) {
  Heads s({Pose{}});
  s.world().value("head_0/base", keys::command_twist) = {{1, 0, 0}, {0, 0, 0.5}};
  s.settle();
  const Pose base = s.pose_of(0, "base");
  EXPECT_GT(base.position.x(), 0.5);
  for (const std::string body : {"mast", "head", "camera", "bumper", "second_finger"}) {
    const Vec3 arm = s.pose_of(0, body).position - base.position;
    const Vec3 expected = s.twist_of(0, "base").linear + Vec3(0, 0, 0.5).cross(arm);
    EXPECT_LT((s.twist_of(0, body).linear - expected).norm(), 1e-14) << body;
    EXPECT_LT((s.twist_of(0, body).angular - Vec3(0, 0, 0.5)).norm(), 1e-14) << body;
  }
}

TEST(DirectKinematics, ASensorRidesOnItsLink) {
  test::Scene s;
  const RobotView& robot = s.add("head", head());
  const ObjectId sensor = s.add_sensor_object(robot, "eye", s.world().object("head/camera"));
  s.use("motion.point", 1, s.all_robots());
  s.use("kinematics.direct", 10, s.all_robots());
  s.build();
  s.run_for(0.05);
  EXPECT_EQ(&s.world().value(sensor, keys::pose), &s.world().value("head/camera", keys::pose));
  EXPECT_DOUBLE_EQ(s.world().value(sensor, keys::pose).position.z(), 0.7);
}

TEST(DirectKinematics, SaysThatItNeedsARobot) {
  test::Scene s;
  s.use("kinematics.direct", 10);
  try {
    s.build();
    FAIL() << "a scene without robots was connected";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("no robot is named"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace muro
