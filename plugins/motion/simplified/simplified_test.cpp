// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;

/// A trunk with a two-link arm, a sliding mass and a finger that mimics the elbow; no part is balanced.
RobotTree arm_robot() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("trunk");
    b.set(keys::inertial, Inertia{.mass = 5, .com = {0.02, 0.01, 0.1}, .ixx = 0.1, .iyy = 0.12, .izz = 0.08});
    b.fork();
    b.translation({0.1, 0, 0.2});
    b.revolute("shoulder", Vec3::UnitY(), {.lower = -2, .upper = 2, .velocity = 4});
    b.body("upper");
    b.set(keys::inertial, Inertia{.mass = 1.5, .com = {0.2, 0, 0}, .ixx = 0.001, .iyy = 0.02, .izz = 0.02});
    b.translation({0.4, 0, 0});
    b.revolute("elbow", Vec3::UnitZ(), {.lower = -2.5, .upper = 2.5, .velocity = 6});
    b.body("lower");
    b.set(keys::inertial, Inertia{.mass = 1, .com = {0.15, 0, 0}, .ixx = 0.001, .iyy = 0.01, .izz = 0.01});
    b.translation({0.3, 0, 0});
    b.revolute("finger", Vec3::UnitZ(), {});
    b.mimic("elbow", -0.5, 0.1);
    b.body("tip");
    b.set(keys::inertial, Inertia{.mass = 0.2, .com = {0.05, 0, 0}, .ixx = 1e-4, .iyy = 2e-4, .izz = 2e-4});
    b.end();
    b.prismatic("slide", Vec3(0, 1, 1), {.lower = -0.2, .upper = 0.3, .velocity = 1});
    b.body("weight");
    b.set(keys::inertial, Inertia{.mass = 2, .com = {0, 0, 0.05}, .ixx = 0.01, .iyy = 0.01, .izz = 0.01});
    b.end();
  });
}

struct Flight : test::Scene {
  const RobotView& robot;
  std::vector<Inertia> inertias;

  explicit Flight(const Parameters& parameters = {}, double rate = 1000, const Twist& twist = {},
                  const Vec3& gravity = {0, 0, -9.81})
      : robot(add("r", arm_robot(), {{1, 2, 3}, from_rpy(0.3, -0.2, 0.9)}, twist)) {
    world().set(world_object, keys::gravity, gravity);
    use("motion.simplified", rate, all_robots(), parameters);
    build();
    for (const Link& f : robot.links) inertias.push_back(world().value(f.object, keys::inertial));
  }
  double& of(const char* joint, const Key<double>& key) { return world().value(std::string("r/") + joint, key); }
  /// Returns the centre of mass in the world, from poses of all bodies.
  Vec3 centre() {
    std::vector<double> q;
    for (const Link& f : robot.links)
      q.push_back(f.joint == JointKind::fixed ? 0 : world().value(f.joint_object, keys::joint_position));
    return pose(robot) * composite_inertia(robot.links, inertias, q).com;
  }
};

TEST(Simplified, TheCentreOfMassFliesAParabolaWhateverTheJointsDo) {
  Flight s({}, 1000, {{0.5, -1, 4}, {1, 2, -1}});
  const Vec3 start = s.centre(), spin(1, 2, -1);
  const Vec3 velocity = Vec3(0.5, -1, 4) + spin.cross(start - s.pose(s.robot).position);
  double error = 0;
  for (int k = 0; k < 200; ++k) {
    s.of("shoulder", keys::joint_velocity_target) = 3 * std::sin(0.3 * k);
    s.of("elbow", keys::joint_velocity_target) = 5 * std::cos(0.2 * k);
    s.of("slide", keys::joint_velocity_target) = k % 20 < 10 ? 0.8 : -0.8;
    s.run_for(0.01);
    const double t = 0.01 * (k + 1);
    error = std::max(error, (s.centre() - start - velocity * t - Vec3(0, 0, -0.5 * 9.81 * t * t)).norm());
  }
  EXPECT_LT(error, 1e-10);  // linear momentum to round-off, over 2000 steps and 20 m
}

TEST(Simplified, TheTwistOfTheBaseIsTheDerivativeOfItsPose) {
  Flight s({}, 10000, {{0, 0, 0}, {1, -2, 0.5}});
  s.of("shoulder", keys::joint_velocity_target) = 2;
  s.of("elbow", keys::joint_velocity_target) = -3;
  s.of("slide", keys::joint_velocity_target) = 0.2;
  s.run_for(0.1);  // joints move steadily now
  const Pose before = s.pose(s.robot);
  s.run_for(0.0001);
  const Twist twist = s.twist(s.robot);
  s.run_for(0.0001);
  const Pose after = s.pose(s.robot);
  EXPECT_LT(((after.position - before.position) / 2e-4 - twist.linear).norm(), 1e-6);
  const Eigen::AngleAxisd turn(after.orientation * before.orientation.conjugate());
  EXPECT_LT((turn.angle() / 2e-4 * turn.axis() - twist.angular).norm(), 1e-6);
}

TEST(Simplified, PullingALimbInSpeedsASpinUp) {
  // I(q) w about the centre of mass is constant. A weight on a radial slide spins about z: w rises as the moment falls.
  test::Scene s;
  const auto tree = test::tree_of([](RobotBuilder& b) {
    b.base("hub");
    b.set(keys::inertial, Inertia{.mass = 1e6, .ixx = 2, .iyy = 2, .izz = 2});
    b.prismatic("slide", Vec3::UnitX(), {});
    b.body("weight");
    b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.01, .iyy = 0.01, .izz = 0.01});
  });
  const RobotView& robot = s.add("r", tree, {}, {{0, 0, 0}, {0, 0, 3}});
  s.world().set(s.world().object("r/slide"), keys::initial_joint_position, 1.0);
  s.use("motion.simplified", 1000, s.all_robots(), {{"joints", "position"}});
  s.build();
  s.world().value("r/slide", keys::joint_position_target) = 0.2;
  s.run_for(3);
  EXPECT_NEAR(s.world().value("r/slide", keys::joint_position), 0.2, 1e-6);
  EXPECT_NEAR(s.twist(robot).angular.z(), 3 * (2.01 + 1.0) / (2.01 + 0.04), 1e-5);
}

TEST(Simplified, AMimicFollowsItsLeader) {
  Flight s;
  s.of("elbow", keys::joint_velocity_target) = 2;
  s.run_for(0.4);
  EXPECT_GT(s.of("elbow", keys::joint_position), 0.7);
  EXPECT_DOUBLE_EQ(s.of("finger", keys::joint_position), 0.1 - 0.5 * s.of("elbow", keys::joint_position));
  EXPECT_DOUBLE_EQ(s.of("finger", keys::joint_velocity), -0.5 * s.of("elbow", keys::joint_velocity));
}

TEST(Simplified, JointsStayWithinTheLimitsOfTheModel) {
  Flight s(Parameters{{"max_joint_acceleration", 50.0}});
  s.of("shoulder", keys::joint_velocity_target) = 100;
  double fastest = 0, farthest = 0;
  for (int k = 0; k < 1000; ++k) {
    s.run_for(0.002);
    fastest = std::max(fastest, s.of("shoulder", keys::joint_velocity));
    farthest = std::max(farthest, s.of("shoulder", keys::joint_position));
  }
  EXPECT_NEAR(fastest, 4, 1e-12);
  EXPECT_EQ(farthest, 2);
  EXPECT_EQ(s.of("shoulder", keys::joint_velocity), 0);
}

TEST(Simplified, IdealPositionTargetsAreReachedWithoutOvershoot) {
  Flight s(Parameters{{"joints", "position"}, {"position_drives", "ideal"}});
  s.of("shoulder", keys::joint_position_target) = 1.1;
  double farthest = 0;
  for (int k = 0; k < 500; ++k) {
    s.run_for(0.002);
    farthest = std::max(farthest, s.of("shoulder", keys::joint_position));
  }
  EXPECT_EQ(farthest, 1.1);
  EXPECT_EQ(s.of("shoulder", keys::joint_position), 1.1);
}

TEST(Simplified, AccelerationTargetsAreIntegratedExactly) {
  Flight s(Parameters{{"joints", "acceleration"}});
  s.of("elbow", keys::joint_acceleration_target) = 1.5;
  s.run_for(1);
  EXPECT_NEAR(s.of("elbow", keys::joint_velocity), 1.5, 1e-12);
  EXPECT_NEAR(s.of("elbow", keys::joint_position), 0.75, 1e-12);
}

TEST(Simplified, RobotsOfABatchMoveAsTheyDoAlone) {
  const auto run = [](int robots) {
    test::Scene s;
    const RobotTree tree = arm_robot();
    for (int k = 0; k < robots; ++k)
      s.add("r" + std::to_string(k), tree, {{double(k), 0, 0}, from_rpy(0, 0, 0.1 * k)}, {{1, 0, 3}, {1, 2, 0.1 * k}});
    s.use("motion.simplified", 500, s.all_robots());
    s.build();
    s.world().value("r0/elbow", keys::joint_velocity_target) = 1;
    s.run_for(1);
    return s.world().hash(*s.world().find_robot("r0"));
  };
  EXPECT_EQ(run(1), run(7));
}

TEST(Simplified, ARestoredSnapshotGoesOnToTheSameBits) {
  Flight s({}, 1000, {{0, 0, 5}, {1, 2, 3}});
  s.of("elbow", keys::joint_velocity_target) = 1;
  s.run_for(0.3);
  const Snapshot middle = s.snapshot();
  s.run_for(0.5);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.5);
  EXPECT_EQ(s.state_hash(), end);
}

/// Returns the message with which a robot is refused.
std::string refusal(const std::function<void(test::Scene&)>& make) {
  test::Scene s;
  make(s);
  s.use("motion.simplified", 1000, s.all_robots());
  try {
    s.build();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Simplified, ARobotWithoutMassIsRefusedWithAdvice) {
  const std::string text = refusal([](test::Scene& s) {
    s.add("ghost", test::single_body(Shape::box({1, 1, 1}), {}));
  });
  EXPECT_NE(text.find("`ghost` has no mass; give its bodies mass and inertia"), std::string::npos) << text;
}

TEST(Simplified, AMassWithoutInertiaIsRefusedWithAdvice) {
  const std::string text = refusal([](test::Scene& s) {
    s.add("point", test::tree_of([](RobotBuilder& b) {
            b.base("body");
            b.set(keys::inertial, {.mass = 2});
          }));
  });
  EXPECT_NE(text.find("all must be positive"), std::string::npos) << text;
}

TEST(Simplified, AJointThatStartsOutsideItsLimitsIsNamed) {
  const std::string text = refusal([](test::Scene& s) {
    s.add("r", arm_robot());
    s.world().set(s.world().object("r/shoulder"), keys::initial_joint_position, 3.0);
  });
  EXPECT_NE(text.find("joint `r/shoulder` starts at 3"), std::string::npos) << text;
}

TEST(Simplified, AStateThatIsNoLongerFiniteEndsTheRunWithTheNameOfTheRobot) {
  Flight s;
  s.twist(s.robot).angular.x() = std::numeric_limits<double>::quiet_NaN();
  try {
    s.run_for(0.01);
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("`r`: the motion of its base is no longer finite"), std::string::npos)
        << e.what();
  }
}

TEST(Simplified, ABoxWithAPlaceholderForItsInertiaIsHeldByTheGround) {
  for (const double moment : {0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-4}) {
    test::Scene s;
    std::vector<std::string> notes;
    s.set_log([&](LogLevel, std::string_view text) { notes.emplace_back(text); });
    s.add_ground();
    const Inertia placeholder{.mass = 1, .ixx = moment, .iyy = moment, .izz = moment};
    const RobotView& box = s.add("crate", test::single_body(Shape::box({0.5, 0.4, 0.3}), placeholder),
                                 {{0, 0, 0.5}, from_rpy(0.4, 0.3, 0)});
    s.use("motion.simplified", 1000, s.all_robots());
    s.use_contacts();
    s.build();
    double highest = 0;
    for (int i = 0; i < 400; ++i) {
      s.run_for(0.01);
      highest = std::max(highest, s.pose(box).position.z());
    }
    EXPECT_LT(highest, 0.5) << moment;
    EXPECT_NEAR(s.pose(box).position.z(), 0.15, 0.02) << moment;
    const auto told = [](const std::string& n) { return n.find("the inertia of `crate` is less than") != n.npos; };
    EXPECT_EQ(std::count_if(notes.begin(), notes.end(), told), 1) << moment;
  }
}

TEST(Simplified, AnInertiaThatABodyCanHaveStaysAsItIs) {
  // a rod of steel, 1 m long and 1 cm thick, and a ball of lead in a large light shell
  const double rod = 0.6, across = rod / 12;
  for (const auto& [shape, inertia] :
       {std::pair(Shape::cylinder(0.005, 1), Inertia{.mass = rod, .ixx = across, .iyy = across, .izz = rod * 1.25e-5}),
        std::pair(Shape::sphere(0.5), Inertia{.mass = 10, .ixx = 0.1, .iyy = 0.1, .izz = 0.1})}) {
    test::Scene s;
    std::vector<std::string> notes;
    s.set_log([&](LogLevel, std::string_view text) { notes.emplace_back(text); });
    s.add("body", test::single_body(shape, inertia));
    s.use("motion.simplified", 1000, s.all_robots());
    s.build();
    EXPECT_EQ(notes, std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace muro
