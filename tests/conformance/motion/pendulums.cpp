// SPDX-License-Identifier: MIT
// Pendulum and top.
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

/// Returns the period of a bob of 1 kg on 1 m in units of that of small swings, from crossings of the lowest point.
double period(const std::string& motion, double amplitude, double armature = 0) {
  Trial t(motion);
  const Inertia bob{.mass = 1, .com = {0, 0, -1}, .ixx = 0.001, .iyy = 0.001, .izz = 0.001};
  t.add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("joint", Vec3::UnitY(), {.armature = armature});
          b.body("rod");
          b.set(keys::inertial, bob);
        }),
        {{0, 0, 3}, Quat::Identity()});
  t.world().set(t.world().object("r/joint"), keys::initial_joint_position, amplitude);
  t.start({{"base", "fixed"}, {"joints", "passive"}});
  const double& q = t.joint("r/joint", keys::joint_position);
  double first = -1, last = -1;
  int crossings = 0;
  for (double before = q; crossings < 5 && t.now() < 60'000'000'000;) {
    t.run_for(0.001);
    if (before * q < 0) {
      last = 1e-9 * double(t.now()) - 0.001 * q / (q - before);
      if (crossings++ == 0) first = last;
    }
    before = q;
  }
  return (last - first) / 2 / (2 * M_PI * std::sqrt(1.001 / g));
}

Outcome small(const std::string& motion) { return relative(period(motion, 10 * M_PI / 180), 1.00190718814); }
/// Checks the period 2 pi sqrt((I + armature) / (m g d)), longer by the factor of swings of 10 deg.
Outcome with_armature(const std::string& motion) {
  constexpr double armature = 0.6;
  return relative(period(motion, 10 * M_PI / 180, armature), 1.00190718814 * std::sqrt((1.001 + armature) / 1.001));
}
Outcome right_angle(const std::string& motion) { return relative(period(motion, 90 * M_PI / 180), 1.18034059902); }
Outcome nearly_upright(const std::string& motion) { return relative(period(motion, 170 * M_PI / 180), 2.43936271967); }

/// Checks that the speed limit, which is that of a drive, does not hold a joint without one.
Outcome fast(const std::string& motion) {
  Trial t(motion);
  t.add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("joint", Vec3::UnitY(), {.velocity = 1});
          b.body("rod");
          b.set(keys::inertial, Inertia{.mass = 1, .com = {0, 0, -1}, .ixx = 0.001, .iyy = 0.001, .izz = 0.001});
        }),
        {{0, 0, 3}, Quat::Identity()});
  t.world().set(t.world().object("r/joint"), keys::initial_joint_position, M_PI / 2);
  t.start({{"base", "fixed"}, {"joints", "passive"}});
  double fastest = 0;
  for (int k = 0; k < 1500; ++k) {
    t.run_for(0.001);
    fastest = std::max(fastest, std::abs(t.joint("r/joint", keys::joint_velocity)));
  }
  return relative(fastest, std::sqrt(2 * g / 1.001));
}

/// Checks the precession of a disc (1 kg, radius 0.1 m) on an axle of 0.1 m, held at its end, that spins at 200 rad/s
/// with the axle `tilt` (rad) from upright. It begins with the speed `expected` (rad/s) and must keep it.
Outcome precession(const std::string& motion, double tilt, double expected) {
  Trial t(motion, 4000);
  const double m = 1, r = 0.1, l = 0.1;
  const Inertia light{.mass = 1e-6, .ixx = 1e-9, .iyy = 1e-9, .izz = 1e-9};
  const Inertia disc{.mass = m, .com = {l, 0, 0}, .ixx = m * r * r / 2, .iyy = m * r * r / 4, .izz = m * r * r / 4};
  t.add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("turn", Vec3::UnitZ(), {});
          b.body("fork");
          b.set(keys::inertial, light);
          b.revolute("nod", Vec3::UnitY(), {});
          b.body("axle");
          b.set(keys::inertial, light);
          b.revolute("spin", Vec3::UnitX(), {});
          b.body("disc");
          b.set(keys::inertial, disc);
        }),
        {{0, 0, 1}, Quat::Identity()});
  t.world().set(t.world().object("r/nod"), keys::initial_joint_position, tilt - M_PI / 2);
  t.start({{"base", "fixed"}, {"joints", "passive"}});
  t.joint("r/spin", keys::joint_velocity) = 200 - expected * std::cos(tilt);  // 200 with the share of the fork's speed
  t.joint("r/turn", keys::joint_velocity) = expected;
  t.run_for(1);
  const double before = t.joint("r/turn", keys::joint_position);
  t.run_for(2);
  return relative((t.joint("r/turn", keys::joint_position) - before) / 2, expected);
}

Outcome level_top(const std::string& motion) { return precession(motion, M_PI / 2, 0.981); }
/// Checks the slow one of two steady precessions, with I3 0.005 and I1 0.0125 kg m^2 about the end of the axle.
Outcome leaning_top(const std::string& motion) { return precession(motion, M_PI / 3, 0.9846357); }

}  // namespace

std::vector<Case> pendulum_cases() {
  constexpr Features needs = feature_fixed_base | feature_joints | feature_forces | feature_joint_friction;
  return {
      {"a pendulum swings 10 deg wide in its time", "relative", needs, 1e-4, small},
      {"a pendulum with a rotor swings in its time", "relative", needs | feature_armature, 1e-4, with_armature},
      {"a pendulum swings 90 deg wide in its time", "relative", needs, 1e-3, right_angle},
      {"a pendulum swings 170 deg wide in its time", "relative", needs, 5e-3, nearly_upright},
      {"a limit of speed does not slow a pendulum", "relative", needs | feature_joint_speed_limits, 2e-3, fast},
      {"a level top goes round at m g l / (I s)", "relative", needs | feature_link_dynamics, 5e-3, level_top},
      {"a top that leans by 60 deg goes round as Euler's equations say", "relative", needs | feature_link_dynamics,
       5e-3, leaning_top},
  };
}

}  // namespace muro::conformance
