// SPDX-License-Identifier: MIT
// motor.servo in front of motion.simplified.
#include <gtest/gtest.h>

#include "tests/support/scene.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;

constexpr double inertia = 0.02;  // kg m^2, of the wheel

/// A wheel that turns about the vertical, and a rod of 0.04 kg m^2 about its end that hangs down.
RobotTree bench(const JointLimits& limits) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("bench");
    b.set(keys::inertial, Inertia{.mass = 10, .ixx = 1, .iyy = 1, .izz = 1});
    b.fork();
    b.revolute("wheel", Vec3::UnitZ(), limits);
    b.body("disc");
    b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.5 * inertia, .iyy = 0.5 * inertia, .izz = inertia});
    b.end();
    b.revolute("arm", Vec3::UnitY(), limits);
    b.body("rod");
    b.set(keys::inertial, Inertia{.mass = 0.75, .com = {0, 0, -0.2}, .ixx = 0.01, .iyy = 0.01, .izz = 1e-4});
    b.end();
  });
}

struct Bench : test::Scene {
  const RobotView& robot;
  explicit Bench(const Parameters& servo, const JointLimits& limits = {}, double rate = 1000, double start = 0,
                 const std::string& motion = "motion.simplified")
      : robot(add("r", bench(limits))) {
    for (const char* joint : {"r/wheel", "r/arm"})
      world().set(world().object(joint), keys::initial_joint_position, start);
    use(motion, rate, all_robots(),
        motion == "motion.point" ? Parameters{} : Parameters{{"joints", "effort"}, {"base", "fixed"}});
    use("motor.servo", rate, all_robots(), servo);
    build();
  }
  double& of(const std::string& joint, const Key<double>& key) { return world().value("r/" + joint, key); }
  double& goal() { return of("wheel", keys::joint_position_target); }
  double q() { return of("wheel", keys::joint_position); }
  double v() { return of("wheel", keys::joint_velocity); }
  double effort() { return of("wheel", keys::joint_effort_target); }
  double rotor() { return of("wheel", Key<double>{"motor.position", "rad or m", ""}); }
};

Parameters with(Parameters a, const Parameters& b) {
  for (const auto& [name, value] : b) a[name] = value;
  return a;
}

TEST(Servo, IsAPlainControllerWithIdealParts) {
  Bench s({{"stiffness", 8.0}, {"damping", 0.1}});
  s.goal() = 1;
  for (int n = 0; n < 500; ++n) {
    const double expected = 8 * (1 - s.q()) - 0.1 * s.v();
    s.run_for(0.001);
    ASSERT_EQ(s.effort(), expected);
    ASSERT_EQ(s.of("wheel", keys::joint_effort), expected);
  }
}

TEST(Servo, AStepOvershootsAsTheSecondOrderSystemDoes) {
  const double k = 8, w = std::sqrt(k / inertia), zeta = 0.3, damped = std::sqrt(1 - zeta * zeta);
  Bench s({{"stiffness", k}, {"damping", 2 * zeta * w * inertia}}, {}, 10000);
  s.goal() = 1;
  double peak = 0, when = 0;
  for (int n = 1; n <= 4000; ++n) {
    s.run_for(0.0001);
    if (s.q() > peak) peak = s.q(), when = 0.0001 * n;
  }
  EXPECT_NEAR(peak - 1, std::exp(-M_PI * zeta / damped), 1e-3);
  EXPECT_NEAR(when, M_PI / (w * damped), 0.002 * when);
}

TEST(Servo, FollowsAVelocity) {
  Bench s({{"mode", "velocity"}, {"damping", 0.5}, {"stiffness", 5.0}}, {.friction = 0.2});
  s.of("wheel", keys::joint_velocity_target) = 3;
  s.run_for(3);
  EXPECT_NEAR(s.v(), 3, 1e-6);
  EXPECT_NEAR(s.effort(), 0.2, 1e-4) << "what friction takes";
}

TEST(Servo, ACommandIsDelayedByWholeRuns) {
  for (const int runs : {1, 5, 17}) {
    Bench s({{"stiffness", 8.0}, {"delay", 0.001 * runs}});
    s.goal() = 1;
    for (int n = 0; n < runs; ++n) {
      s.run_for(0.001);
      ASSERT_EQ(s.effort(), 0) << n << " of " << runs;
    }
    s.run_for(0.001);
    EXPECT_EQ(s.effort(), 8);
    s.goal() = 0.5;
    s.run_for(0.001 * runs);
    EXPECT_NEAR(s.effort(), 8 * (1 - s.q()), 0.1) << "still the old one";
  }
}

TEST(Servo, TheOffsetIsTheTruePositionLessTheMeasuredOne) {
  // m g l sin(q) = k (goal - (q - offset)) at rest, for the rod; no load turns the wheel
  const double k = 8, offset = 0.15, goal = 0.3;
  Bench s({{"stiffness", k}, {"damping", 0.4}, {"offset", offset}}, {}, 1000, 0.2);
  s.run_for(0.5);
  EXPECT_NEAR(s.q(), 0.2, 1e-12) << "without a command it stays where it is";
  s.goal() = s.of("arm", keys::joint_position_target) = goal;
  s.run_for(5);
  EXPECT_NEAR(s.q(), goal + offset, 1e-9);
  EXPECT_NEAR(s.of("wheel", Key<double>{"servo.position", "rad or m", ""}), goal, 1e-9);
  EXPECT_EQ(s.of("wheel", Key<double>{"servo.offset", "rad or m", ""}), offset);
  const double q = s.of("arm", keys::joint_position);
  EXPECT_NEAR(0.75 * 9.81 * 0.2 * std::sin(q), k * (goal + offset - q), 1e-3);
}

TEST(Servo, TheEncoderRoundsWhatTheControllerSees) {
  const double step = 2 * M_PI / 4096;
  Bench s({{"stiffness", 8.0}, {"damping", 0.2}, {"encoder_resolution", step}}, {.damping = 0.1});
  s.goal() = 0.3;
  s.run_for(3);
  EXPECT_NEAR(s.q(), 0.3, step);
  const double seen = s.of("wheel", Key<double>{"servo.position", "rad or m", ""});
  EXPECT_NEAR(seen / step, std::round(seen / step), 1e-9);
}

TEST(Servo, SpeedsUpOnTheLineOfTheMotor) {
  // Full voltage on an inertia: w0 (1 - exp(-t / T)) with the mechanical time constant T = J w0 / M0.
  const double stall = 2, fastest = 5, constant = inertia * fastest / stall;
  Bench s({{"stiffness", 1e6}, {"stall_torque", stall}, {"no_load_speed", fastest}}, {}, 10000);
  s.goal() = 1000;
  s.run_for(0.0001);
  EXPECT_EQ(s.effort(), stall) << "at standstill";
  s.run_for(constant - 0.0001);
  EXPECT_NEAR(s.v(), fastest * (1 - std::exp(-1)), 0.005 * fastest);
  s.run_for(20 * constant);
  EXPECT_NEAR(s.v(), fastest, 1e-6) << "unloaded";
  EXPECT_NEAR(s.effort(), 0, 1e-6);
}

TEST(Servo, SettlesWhereTheLineMeetsTheLoad) {
  // M0 (1 - w / w0) = c w, whatever the gear between motor and joint.
  const double stall = 2, fastest = 5, load = 0.3, expected = stall / (stall / fastest + load);
  for (const double ratio : {1.0, 50.0})
    for (const double rotor : {0.0, 0.01}) {
      Bench s({{"stiffness", 1e6},
               {"gear_ratio", ratio},
               {"stall_torque", stall / ratio},
               {"no_load_speed", fastest * ratio},
               {"rotor_inertia", rotor / (ratio * ratio)}},
              {.damping = load});
      s.goal() = 1000;
      s.run_for(2);
      EXPECT_NEAR(s.v(), expected, 1e-6) << ratio << " " << rotor;
      EXPECT_NEAR(s.effort(), load * expected, 1e-6);
    }
}

TEST(Servo, TheLimitOfTheCurrentLimitsTheEffort) {
  Bench s({{"stiffness", 1e6},
           {"max_torque", 0.01},
           {"gear_ratio", 100.0},
           {"stall_torque", 5.0},
           {"no_load_speed", 900.0}});
  s.goal() = 1000;
  s.run_for(0.1);
  EXPECT_NEAR(s.v(), 0.1 * 1.0 / inertia, 1e-9);
}

TEST(Servo, TheRotorIsFeltThroughTheGear) {
  const double ratio = 20, rotor = 5e-5;  // 0.02 kg m^2 at the output: as much as the joint
  Bench s({{"stiffness", 1e6}, {"max_torque", 0.01}, {"gear_ratio", ratio}, {"rotor_inertia", rotor}});
  s.goal() = 1000;
  s.run_for(0.5);
  EXPECT_NEAR(s.v(), 0.5 * 0.01 * ratio / (inertia + rotor * ratio * ratio), 1e-4);
}

const Parameters loose{
    {"stiffness", 20.0}, {"damping", 1.0}, {"rotor_inertia", 0.004}, {"encoder", "motor"}, {"backlash", 0.05}};

/// Moves slowly to `goal`, so that the joint does not coast; returns the position at which the joint comes to rest.
double creep(Bench& s, double goal) {
  for (int k = 0; s.goal() != goal && k < 100'000; ++k) {
    s.goal() += std::clamp(goal - s.goal(), -5e-5, 5e-5);
    s.run_for(0.001);
  }
  s.run_for(1);
  return s.q();
}

TEST(Servo, TheJointStandsStillWhileTheRotorCrossesTheBacklash) {
  Bench s(loose, {.damping = 0.05, .friction = 0.05});
  const double there = creep(s, 0.2);
  EXPECT_NEAR(s.rotor() - there, 0.025, 1e-3) << "lies on the flank that pushed";
  EXPECT_EQ(creep(s, 0.2 - 0.045), there) << "the rotor crosses 0.045 of the 0.05 rad";
  EXPECT_NEAR(creep(s, 0.2 - 0.06), there - 0.01 + 2 * 0.05 / 20, 1e-3) << "less friction of the joint by stiffness";
}

TEST(Servo, BacklashIsTheHysteresisOfThePosition) {
  for (const double gap : {0.02, 0.05}) {
    Bench s(with(loose, {{"backlash", gap}}), {.damping = 0.05, .friction = 0.05});
    const double from_below = creep(s, 0.2);
    creep(s, 0.4);
    EXPECT_NEAR(creep(s, 0.2) - from_below, gap + 2 * 0.05 / 20, 1e-3) << "and the friction of the joint by stiffness";
  }
}

TEST(Servo, AnEncoderOnTheMotorAvoidsTheLimitCycleOfBacklash) {
  // Nordin and Gutman, Section 3: the integral of an error that the gap hides grows until the rotor jumps.
  const auto swing = [](const char* encoder) {
    Bench s(with(loose, {{"encoder", encoder}, {"integral", 40.0}, {"damping", 0.3}}), {.damping = 0.02});
    s.goal() = 0.5;
    s.run_for(20);
    double low = 1e9, high = -1e9;
    for (int n = 0; n < 5000; ++n) {
      s.run_for(0.001);
      low = std::min(low, s.rotor()), high = std::max(high, s.rotor());
    }
    return high - low;
  };
  EXPECT_GT(swing("output"), 0.025);
  EXPECT_LT(swing("motor"), 1e-6);
}

TEST(Servo, FrictionOfTheGearHoldsALoadWithoutChatter) {
  // 0.75 kg at 0.2 m: 1.47 N m sin(angle). The controller asks for almost nothing.
  const Parameters worm{{"stiffness", 1e-9}, {"rotor_inertia", 0.01}, {"friction", 0.8}};
  Bench s(worm, {.damping = 0.01}, 1000, 0.5);  // 0.71 N m
  s.run_for(5);
  const double q = s.of("arm", keys::joint_position);
  EXPECT_NEAR(q, 0.5, 0.01);
  for (int n = 0; n < 1000; ++n) {
    s.run_for(0.001);
    ASSERT_NEAR(s.of("arm", keys::joint_position), q, 1e-7);
  }
  EXPECT_EQ(s.of("arm", Key<double>{"motor.velocity", "rad/s or m/s", ""}), 0);
  Bench heavy(worm, {.damping = 0.01}, 1000, 0.7);  // 0.95 N m
  heavy.run_for(5);
  EXPECT_LT(heavy.of("arm", keys::joint_position), 0.6);
}

const Parameters real{{"stiffness", 20.0},
                      {"damping", 0.5},
                      {"integral", 10.0},
                      {"delay", 0.007},
                      {"encoder_resolution", 0.0015},
                      {"speed_filter", 0.003},
                      {"gear_ratio", 353.5},
                      {"stall_torque", 0.0116},
                      {"no_load_speed", 1700.0},
                      {"rotor_inertia", 2e-8},
                      {"efficiency", 0.7},
                      {"friction", 0.05},
                      {"backlash", 0.004}};

TEST(Servo, GoesOnFromASnapshotToTheSameBits) {
  Bench s(real);
  s.goal() = 0.7;
  s.run_for(0.2137);
  s.goal() = 0.2;
  s.run_for(0.0031);
  const Snapshot middle = s.snapshot();
  s.run_for(0.5);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.5);
  EXPECT_EQ(s.state_hash(), end);
}

/// The integral does not keep the error of a slow commanded motion when forces move the joint again.
TEST(Servo, ItsIntegralRestsWhileNoForceMovesTheRobot) {
  test::Scene s;
  const RobotView& r = s.add("r", bench({}));
  s.set_levels(r, {"forces", "commanded"}, 0);
  s.use("motion.simplified", 1000, {{&r, r.base(), 0}}, {{"joints", "effort"}, {"base", "fixed"}});
  s.use("motion.point", 1000, {{&r, r.base(), 1}}, {{"joints", "position"}});
  s.use("motor.servo", 1000, s.all_robots(), {{"stiffness", 20.0}, {"damping", 1.5}, {"integral", 100.0}});
  s.build();
  const auto of = [&](const std::string& joint, const Key<double>& key) -> double& {
    return s.world().value("r/" + joint, key);
  };
  const Key<double> integral{"servo.integral", "N m or N", ""};
  const double level = 0.75 * 9.81 * 0.2;  // N m, holds the rod when it is level
  of("arm", keys::joint_position_target) = M_PI / 2;
  s.run_for(5);
  ASSERT_NEAR(std::abs(of("arm", integral)), level, 1e-3) << "it holds the rod";
  s.world().value(r.base(), keys::motion_level_target) = 1;
  s.run_for(0.01);
  for (const double goal : {-1.0, M_PI / 2}) {  // on the way each error would add up
    of("arm", keys::joint_position_target) = goal;
    of("wheel", keys::joint_position_target) = goal;
    s.run_for(goal < 0 ? 1 : 3);
  }
  EXPECT_NEAR(std::abs(of("arm", integral)), level, 1e-2) << "and keeps that";
  s.world().value(r.base(), keys::motion_level_target) = 0;
  double farthest = 0;
  for (int k = 0; k < 500; ++k) {
    s.run_for(0.001);
    farthest = std::max(farthest, std::abs(of("arm", keys::joint_position) - M_PI / 2));
    farthest = std::max(farthest, std::abs(of("wheel", keys::joint_position) - M_PI / 2));
  }
  EXPECT_LT(farthest, 0.01) << "rad";
}

TEST(Servo, ServosOfABatchMoveAsTheyDoAlone) {
  const auto run = [](int robots) {
    test::Scene s;
    const RobotTree tree = bench({.damping = 0.01});
    for (int k = 0; k < robots; ++k) s.add("r" + std::to_string(k), tree, {{double(k), 0, 0}, Quat::Identity()});
    s.use("motion.simplified", 1000, s.all_robots(), {{"joints", "effort"}, {"base", "fixed"}});
    s.use("motor.servo", 1000, s.all_robots(), real);
    s.build();
    s.world().value("r0/arm", keys::joint_position_target) = 0.4;
    s.run_for(0.5);
    return s.world().hash(*s.world().find_robot("r0"));
  };
  EXPECT_EQ(run(1), run(5));
}

TEST(Servo, ARealServoReachesItsGoal) {
  Bench s(real, {.damping = 0.01});
  s.goal() = 0.7;
  s.of("arm", keys::joint_position_target) = 0.3;
  s.run_for(6);
  EXPECT_NEAR(s.q(), 0.7, 0.005);
  EXPECT_NEAR(s.of("arm", keys::joint_position), 0.3, 0.005);
}

TEST(Servo, DrivesNamedJointsAndNoOthers) {
  Bench s({{"joints", Names{"wh*"}}, {"stiffness", 8.0}});
  s.goal() = 1;
  s.run_for(0.01);
  EXPECT_GT(s.effort(), 7);
  EXPECT_FALSE(s.world().store().find(s.world().object("r/arm"), "servo.position"));
}

TEST(Servo, IsNoErrorOnALevelWithoutJoints) {
  Bench s({{"stiffness", 8.0}}, {}, 1000, 0, "motion.point");
  s.run_for(0.1);
}

std::string refusal(const Parameters& servo) {
  try {
    Bench s(servo);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Servo, MistakesAreNamedWithAdvice) {
  const std::pair<Parameters, std::string> cases[] = {
      {{}, "`stiffness` is 0, so a servo of positions does nothing"},
      {{{"mode", "velocity"}}, "give `damping`, in N m s/rad"},
      {{{"stiffness", 1.0}, {"stall_torque", 2.0}}, "the torque-speed line needs both"},
      {{{"stiffness", 1.0}, {"backlash", 0.01}}, "`backlash` is 0.01, which needs a rotor"},
      {{{"stiffness", 1.0}, {"efficiency", 0.8}}, "`efficiency` is 0.8, which needs a rotor"},
      {{{"stiffness", 1.0}, {"encoder", "motor"}}, "`encoder` is motor, which needs a rotor"},
      {{{"stiffness", 1.0}, {"joints", Names{"whel"}}}, "no such joint to drive (did you mean `wheel`?)"},
      {{{"mode", "velocity"}, {"damping", 1.0}, {"integral", 1.0}}, "`integral` belongs to mode `position`"},
  };
  for (const auto& [servo, text] : cases)
    EXPECT_NE(refusal(servo).find(text), std::string::npos) << text << "\n" << refusal(servo);
}

}  // namespace
}  // namespace muro
