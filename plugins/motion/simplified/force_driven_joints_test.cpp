// SPDX-License-Identifier: MIT
// Tests of joints that forces move, through motion.simplified.
#include <gtest/gtest.h>

#include "core/instance.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;

constexpr double g = 9.81;

struct Machine : test::Scene {
  const RobotView& robot;
  explicit Machine(const RobotTree& tree, const Parameters& parameters, double start = 0, double rate = 1000)
      : robot(add("r", tree)) {
    for (const Link& f : robot.links)
      if (f.joint != JointKind::fixed && f.mimic < 0) world().set(f.joint_object, keys::initial_joint_position, start);
    use("motion.simplified", rate, all_robots(), parameters);
    build();
  }
  double& of(const std::string& joint, const Key<double>& key) { return world().value("r/" + joint, key); }
};

/// A rod of 0.4 m and 1 kg that hangs from a base and swings about y.
RobotTree pendulum(const JointLimits& limits = {}) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("frame");
    b.set(keys::inertial, Inertia{.mass = 3, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
    b.revolute("pivot", Vec3::UnitY(), limits);
    b.body("rod");
    b.set(keys::inertial, Inertia{.mass = 1, .com = {0, 0, -0.2}, .ixx = 0.16 / 12, .iyy = 0.16 / 12, .izz = 1e-4});
  });
}
constexpr double rod_inertia = 0.16 / 12 + 0.04;

/// A mass of 2 kg on a slide along x, on a base of 3 kg.
RobotTree slider(const JointLimits& limits = {}) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("frame");
    b.set(keys::inertial, Inertia{.mass = 3, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
    b.prismatic("slide", Vec3::UnitX(), limits);
    b.body("weight");
    b.set(keys::inertial, Inertia{.mass = 2, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
  });
}

/// Returns the period in s, from twenty half swings between crossings of 0.
double period(Machine& s) {
  double first = 0, last = 0, before = s.of("pivot", keys::joint_position);
  int crossings = 0;
  for (double t = 0.001; crossings < 21; t += 0.001) {
    s.run_for(0.001);
    const double now = s.of("pivot", keys::joint_position);
    if ((before > 0) != (now > 0)) {
      last = t - 0.001 * now / (now - before);
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  return (last - first) / 10;
}

TEST(ForceDrivenJoints, APassivePendulumHasThePeriodsOfTheEllipticIntegral) {
  const double small = 2 * M_PI * std::sqrt(rod_inertia / (1 * g * 0.2));
  const std::pair<double, double> table[] = {{10, 1.00190718814}, {90, 1.18034059902}, {170, 2.43936271967}};
  for (const auto& [degrees, ratio] : table) {
    Machine s(pendulum(), {{"joints", "passive"}, {"base", "fixed"}}, degrees * M_PI / 180);
    EXPECT_NEAR(period(s) / small, ratio, 2e-6 * ratio) << degrees;
  }
}

TEST(ForceDrivenJoints, APendulumKeepsItsEnergyForMinutes) {
  Machine s(pendulum(), {{"joints", "passive"}, {"base", "fixed"}}, 2);
  const auto energy = [&] {
    const double v = s.of("pivot", keys::joint_velocity);
    return 0.5 * rod_inertia * v * v - g * 0.2 * std::cos(s.of("pivot", keys::joint_position));
  };
  const double start = energy();
  double worst = 0;
  for (int n = 0; n < 1000; ++n) {
    s.run_for(0.18);
    worst = std::max(worst, std::abs(energy() - start));
  }
  EXPECT_LT(worst, 1e-5 * g * 0.2);
}

TEST(ForceDrivenJoints, AFixedBaseStaysWhereItStarts) {
  Machine s(pendulum(), {{"joints", "passive"}, {"base", "fixed"}}, 2);
  s.run_for(3);
  EXPECT_EQ(s.pose(s.robot).position, Vec3::Zero());
  EXPECT_EQ(s.twist(s.robot).linear, Vec3::Zero());
}

TEST(ForceDrivenJoints, AnEffortBetweenTwoFreeMassesMovesBoth) {
  // 4 N between 3 and 2 kg: the reduced mass is 1.2 kg; the centre of mass only falls.
  Machine s(slider(), {{"joints", "effort"}});
  s.of("slide", keys::joint_effort_target) = 4;
  s.run_for(1);
  EXPECT_NEAR(s.of("slide", keys::joint_velocity), 4 / 1.2, 1e-9);
  EXPECT_NEAR(s.of("slide", keys::joint_position), 2 / 1.2, 1e-9);
  EXPECT_NEAR(s.pose(s.robot).position.x(), -0.5 * 4 / 3, 1e-9);
  EXPECT_NEAR(s.twist(s.robot).linear.x(), -4 / 3.0, 1e-9);
  EXPECT_NEAR(s.pose(s.robot).position.z(), -0.5 * g, 1e-9);
  EXPECT_EQ(s.of("slide", keys::joint_effort), 4);
}

TEST(ForceDrivenJoints, LimitsDampingAndFrictionAreThoseOfTheModel) {
  const Parameters fixed{{"joints", "effort"}, {"base", "fixed"}};
  {
    Machine s(slider({.effort = 3}), fixed);
    s.of("slide", keys::joint_effort_target) = 100;
    s.run_for(1);
    EXPECT_NEAR(s.of("slide", keys::joint_velocity), 1.5, 1e-9) << "3 N on 2 kg";
    EXPECT_EQ(s.of("slide", keys::joint_effort), 3);
  }
  {
    Machine s(slider({.damping = 4}), fixed);
    s.of("slide", keys::joint_effort_target) = 6;
    s.run_for(1);
    EXPECT_NEAR(s.of("slide", keys::joint_velocity), 1.5 * (1 - std::exp(-2)), 1e-3);
  }
  {
    Machine s(slider({.friction = 4}), fixed);
    s.of("slide", keys::joint_velocity) = 3;
    s.run_for(3);
    EXPECT_NEAR(s.of("slide", keys::joint_position), 3 * 3 * 2 / (2 * 4.0), 1e-9);
    const double rests = s.of("slide", keys::joint_position);
    s.of("slide", keys::joint_effort_target) = 3.99;
    s.run_for(1);
    EXPECT_EQ(s.of("slide", keys::joint_position), rests);
  }
  {
    Machine s(slider({.lower = -1, .upper = 0.5, .velocity = 0.8}), fixed);
    s.of("slide", keys::joint_effort_target) = 6;
    s.run_for(0.5);
    EXPECT_EQ(s.of("slide", keys::joint_velocity), 0.8);
    s.run_for(2);
    EXPECT_EQ(s.of("slide", keys::joint_position), 0.5);
    EXPECT_EQ(s.of("slide", keys::joint_velocity), 0);
  }
}

TEST(ForceDrivenJoints, TheArmatureIsFeltAsInertia) {
  Machine s(slider(), {{"joints", "effort"}, {"base", "fixed"}, {"armature", 1.0}});
  s.of("slide", keys::joint_effort_target) = 6;
  s.run_for(1);
  EXPECT_NEAR(s.of("slide", keys::joint_velocity), 2, 1e-9);
}

/// A gripper: two fingers on slides; one mimics the other.
RobotTree gripper() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("palm");
    b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
    b.fork();
    b.prismatic("left", Vec3::UnitY(), {.damping = 1});
    b.body("left_finger");
    b.set(keys::inertial, Inertia{.mass = 0.2});
    b.end();
    b.prismatic("right", Vec3::UnitY(), {.damping = 1});
    b.mimic("left", -2, 0.01);
    b.body("right_finger");
    b.set(keys::inertial, Inertia{.mass = 0.1});
    b.end();
  });
}

TEST(ForceDrivenJoints, AMimicAddsItsMassAndItsDampingToItsLeader) {
  Machine s(gripper(), {{"joints", "effort"}, {"base", "fixed"}});
  s.of("left", keys::joint_effort_target) = 3;
  s.run_for(0.2);
  const double mass = 0.2 + 4 * 0.1, damping = 1 + 4 * 1;
  EXPECT_NEAR(s.of("left", keys::joint_velocity), 3 / damping * (1 - std::exp(-0.2 * damping / mass)), 1e-3);
  EXPECT_DOUBLE_EQ(s.of("right", keys::joint_velocity), -2 * s.of("left", keys::joint_velocity));
  EXPECT_DOUBLE_EQ(s.of("right", keys::joint_position), 0.01 - 2 * s.of("left", keys::joint_position));
}

/// A trunk with three joints that nothing couples.
RobotTree three_joints() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("trunk");
    b.set(keys::inertial, Inertia{.mass = 5, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
    for (const char* name : {"a", "b"}) {
      b.fork();
      b.prismatic(name, Vec3::UnitX(), {});
      b.body(std::string(name) + "_body");
      b.set(keys::inertial, Inertia{.mass = 0.5});
      b.end();
    }
    b.prismatic("c", Vec3::UnitY(), {});
    b.body("c_body");
    b.set(keys::inertial, Inertia{.mass = 0.5});
    b.end();
    b.end();
  });
}

TEST(ForceDrivenJoints, EachJointHasAModeOfItsOwn) {
  Machine s(three_joints(), {{"base", "fixed"}, {"position_joints", Names{"b"}}, {"effort_joints", Names{"c"}}});
  s.of("a", keys::joint_velocity_target) = 0.3;
  s.of("b", keys::joint_position_target) = 0.2;
  s.of("c", keys::joint_effort_target) = 0.1;
  s.run_for(2);
  EXPECT_NEAR(s.of("a", keys::joint_velocity), 0.3, 1e-12);
  EXPECT_NEAR(s.of("b", keys::joint_position), 0.2, 1e-12);
  EXPECT_NEAR(s.of("c", keys::joint_velocity), 0.4, 1e-9);
}

TEST(ForceDrivenJoints, MixedTargetsMoveJointsAsTheyDoAlone) {
  const auto at_end = [](const Parameters& parameters, const char* joint) {
    Machine s(three_joints(), parameters);
    s.world().value("r/" + std::string(joint),
                    *joint == 'a' ? keys::joint_velocity_target : keys::joint_position_target) = 0.37;
    s.run_for(0.1);
    return std::pair(s.of(joint, keys::joint_position), s.of(joint, keys::joint_velocity));
  };
  const Parameters mixed{{"position_joints", Names{"b", "c"}}};
  EXPECT_EQ(at_end(mixed, "a"), at_end({{"joints", "velocity"}}, "a"));
  EXPECT_EQ(at_end(mixed, "b"), at_end({{"joints", "position"}}, "b"));
}

TEST(ForceDrivenJoints, ALimitedDriveHoldsALightLoadAndYieldsToAHeavyOne) {
  for (const double most : {1.0, 3.0}) {  // the rod needs 1.962 N m at the horizontal
    Machine s(pendulum({.effort = most}), {{"joints", "position"}, {"base", "fixed"}, {"effort_limits", true}},
              -M_PI / 2);
    s.run_for(3);
    if (most > 2) {
      EXPECT_NEAR(std::abs(s.of("pivot", keys::joint_position) + M_PI / 2), g * 0.2 / (1e4 * rod_inertia), 1e-6);
      EXPECT_NEAR(std::abs(s.of("pivot", keys::joint_effort)), g * 0.2, 1e-4);
    } else {
      EXPECT_GT(std::abs(s.of("pivot", keys::joint_position) + M_PI / 2), 0.5);
    }
  }
}

TEST(ForceDrivenJoints, GainsThatFitNoJointAreRefusedWithAdvice) {
  constexpr std::pair<const char*, const char*> cases[] = {
      {"pivto=5", "`stiffness` names `pivto`, but `r` has no such joint in mode `position` (did you mean `pivot`?)"},
      {"pivot=soft", "`stiffness`: `pivot=soft` is no gain; write a number from 0 to 1e15, or a map of joints"},
      {"pivot=-1", "is no gain"}};
  for (const auto& [given, says] : cases) {
    try {
      Machine s(pendulum(), {{"joints", "position"}, {"stiffness", Names{given}}});
      ADD_FAILURE() << given;
    } catch (const std::exception& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
}

TEST(ForceDrivenJoints, APositionDriveOfAFallingRobotNeedsNoEffort) {
  for (const bool gives_way : {false, true}) {
    Machine s(pendulum({.effort = 50}), {{"joints", "position"}, {"effort_limits", gives_way}});
    s.run_for(0.1);
    EXPECT_NEAR(s.of("pivot", keys::joint_position), 0, 1e-6) << "in free fall nothing loads it";
    EXPECT_NEAR(s.of("pivot", keys::joint_effort), 0, 1e-6);
  }
}

TEST(ForceDrivenJoints, GoOnFromASnapshotToTheSameBits) {
  Machine s(pendulum({.damping = 0.01, .friction = 0.02}), {{"joints", "effort"}}, 1);
  s.run_for(0.4);
  const Snapshot middle = s.snapshot();
  s.of("pivot", keys::joint_effort_target) = 0.3;
  s.run_for(0.5);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.of("pivot", keys::joint_effort_target) = 0.3;
  s.run_for(0.5);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(ForceDrivenJoints, RobotsOfABatchMoveAsTheyDoAlone) {
  const auto run = [](int robots) {
    test::Scene s;
    const RobotTree tree = three_joints();
    for (int k = 0; k < robots; ++k) s.add("r" + std::to_string(k), tree, {{double(k), 0, 0}, from_rpy(0, 0, 0.1 * k)});
    s.use("motion.simplified", 500, s.all_robots(), {{"position_joints", Names{"b"}}, {"effort_joints", Names{"c"}}});
    s.build();
    s.world().value("r0/a", keys::joint_velocity_target) = 1;
    s.world().value("r0/b", keys::joint_position_target) = 0.2;
    s.world().value("r0/c", keys::joint_effort_target) = 0.7;
    s.run_for(1);
    return s.world().hash(*s.world().find_robot("r0"));
  };
  EXPECT_EQ(run(1), run(9));
}

TEST(ForceDrivenJoints, AnyStateThatAnotherMotionLeavesIsTakenOver) {
  Machine s(slider({.lower = -1, .upper = 0.5}), {{"joints", "effort"}, {"base", "fixed"}});
  s.of("slide", keys::joint_position) = 0.6;  // the other motion did not know the limit
  s.of("slide", keys::joint_velocity) = -0.1;
  s.twist(s.robot).linear = {1, 2, 3};
  abi::ErrorText error;
  ASSERT_TRUE(s.instances().front()->on_handover(0, error)) << error.view();
  s.run_for(0.5);
  EXPECT_EQ(s.twist(s.robot).linear, Vec3::Zero());
  EXPECT_LE(s.of("slide", keys::joint_position), 0.5);
}

TEST(ForceDrivenJoints, AJointWithoutInertiaIsRefusedWithAdvice) {
  const RobotTree tree = test::tree_of([](RobotBuilder& b) {
    b.base("frame");
    b.set(keys::inertial, Inertia{.mass = 3, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
    b.revolute("pan", Vec3::UnitZ(), {});
    b.body("camera");
  });
  try {
    Machine s(tree, {{"joints", "effort"}});
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("joint `r/pan` moves an inertia of 0"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("`armature`"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace muro
