// SPDX-License-Identifier: MIT
// Drives that follow positions, on bases that are fixed to the world: PD controllers, compared with oscillators.
#include <array>

#include "tests/conformance/motion/case.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {

namespace {

constexpr double drive_step = 1e-3;
using Names = std::vector<std::string>;

/// One link that turns about y, with an inertia of 0.26 kg m^2 about the joint; gravity acts on 1 kg at 0.5 m.
struct OneLink : Trial {
  static constexpr double moment = 0.26, weight = g * 0.5;

  OneLink(const std::string& motion, const JointLimits& limits, std::map<std::string, ParameterInput> parameters,
          bool gravity = false)
      : Trial(motion) {
    if (!gravity) set_gravity(Vec3::Zero());
    add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("joint", Vec3::UnitY(), limits);
          b.body("arm");
          b.set(keys::inertial, Inertia{.mass = 1, .com = {0.5, 0, 0}, .ixx = 0.01, .iyy = 0.01, .izz = 0.01});
        }),
        {{0, 0, 1}, Quat::Identity()});
    parameters.insert({{"base", "fixed"}, {"joints", "position"}});
    start(parameters);
  }
  double& of(const Key<double>& key) { return joint("r/joint", key); }
};

/// Checks the default gains, which follow from link and rotor together: critically damped.
Outcome step_response(const std::string& motion, double armature) {
  constexpr double frequency = 20;
  OneLink link(motion, {.armature = armature}, {{"natural_frequency", frequency}});
  link.of(keys::joint_position_target) = 0.5;
  double worst = 0;
  for (int k = 1; k <= 500; ++k) {
    link.run_for(drive_step);
    const double x = frequency * drive_step * k, exact = 0.5 * (1 - (1 + x) * std::exp(-x));
    worst = std::max(worst, std::abs(link.of(keys::joint_position) - exact) / 0.5);
  }
  return {worst, text(worst)};
}
Outcome drive_step_response(const std::string& motion) { return step_response(motion, 0); }
Outcome drive_rotor_frequency(const std::string& motion) { return step_response(motion, 2 * OneLink::moment); }

/// Checks an underdamped drive with given gains: its first overshoot is exp(-pi zeta / sqrt(1 - zeta^2)).
Outcome overshoot(const std::string& motion, double armature) {
  constexpr double stiffness = 100, zeta = 0.4;
  const double damping = 2 * zeta * std::sqrt(stiffness * (OneLink::moment + armature));
  OneLink link(motion, {.armature = armature},
               {{"stiffness", Names{"joint=" + text(stiffness)}}, {"damping", Names{"*=" + text(damping)}}});
  link.of(keys::joint_position_target) = 0.5;
  double farthest = 0;
  for (int k = 0; k < 1000; ++k) {
    link.run_for(drive_step);
    farthest = std::max(farthest, link.of(keys::joint_position));
  }
  return relative(farthest, 0.5 * (1 + std::exp(-M_PI * zeta / std::sqrt(1 - zeta * zeta))));
}
Outcome drive_overshoot(const std::string& motion) { return overshoot(motion, 0); }
/// Checks that a rotor with twice the inertia of the link counts as much as the link does.
Outcome drive_rotor(const std::string& motion) { return overshoot(motion, 2 * OneLink::moment); }

Outcome drive_deflection(const std::string& motion) {
  constexpr double stiffness = 100;
  OneLink link(motion, {}, {{"stiffness", stiffness}}, true);
  link.of(keys::joint_position_target) = 0.2;
  link.run_for(3);
  const double q = link.of(keys::joint_position);
  return relative(stiffness * (q - 0.2), OneLink::weight * std::cos(q));
}

Outcome drive_stiff(const std::string& motion) {
  double worst = 0;
  std::string seen;
  for (const char* damping : {"joint=0", "joint=20"}) {
    OneLink link(motion, {}, {{"stiffness", Names{"joint=1e6"}}, {"damping", Names{damping}}}, true);
    link.of(keys::joint_position_target) = 0.5;
    double fastest = 0;
    for (int k = 0; k < 2000; ++k) {
      link.run_for(drive_step);
      fastest = std::max(fastest, std::abs(link.of(keys::joint_velocity)));
    }
    const double q = link.of(keys::joint_position), off = std::abs(q - 0.5) + std::abs(link.of(keys::joint_velocity));
    worst = std::max({worst, off, fastest > 1.01 * 0.5 / drive_step ? fastest : 0});
    seen += text(q) + " for 0.5, up to " + text(fastest) + " rad/s; ";
  }
  return {worst, seen};
}

/// Checks that Coulomb friction holds the link until the drive is stronger, and then takes its part of the effort.
Outcome drive_friction(const std::string& motion) {
  OneLink held(motion, {.friction = 2}, {{"stiffness", Names{"joint=100"}}});
  held.of(keys::joint_position_target) = 0.019;
  held.run_for(1);
  const double moved = std::abs(held.of(keys::joint_position)), told = held.of(keys::joint_effort);
  OneLink turned(motion, {.friction = 2}, {{"stiffness", Names{"joint=100"}}});
  turned.of(keys::joint_position_target) = 0.5;
  turned.run_for(3);
  const double left = 0.5 - turned.of(keys::joint_position);
  return {std::max({moved, std::abs(told - 1.9) / 1.9, left > 0.0201 ? left : 0}),
          text(moved) + " rad, " + text(told) + " for 1.9 N m, " + text(left) + " rad short of the target"};
}

Outcome drive_effort_limit(const std::string& motion) {
  OneLink link(motion, {.effort = 0.13}, {});
  link.of(keys::joint_position_target) = 10;
  link.run_for(1);
  const Outcome speed = relative(link.of(keys::joint_velocity), 0.13 / OneLink::moment),
                told = relative(link.of(keys::joint_effort), 0.13);
  return {std::max(speed.error, told.error), speed.seen + "; " + told.seen};
}

Outcome drive_speed_limit(const std::string& motion) {
  OneLink link(motion, {.velocity = 1.5}, {});
  link.of(keys::joint_position_target) = 3;
  double fastest = 0;
  for (int k = 0; k < 1000; ++k) {
    link.run_for(drive_step);
    fastest = std::max(fastest, link.of(keys::joint_velocity));
  }
  link.run_for(2);
  const Outcome there = relative(link.of(keys::joint_position), 3), speed = relative(fastest, 1.5);
  return {std::max(there.error, speed.error), there.seen + "; " + speed.seen};
}

Outcome sine(const std::string& motion) {
  constexpr double amplitude = 0.5, rate = M_PI, period = 0.01;
  OneLink link(motion, {}, {{"interpolate", period}});
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const double t = k * drive_step;
    if (k % 10 == 0) link.of(keys::joint_position_target) = amplitude * std::sin(rate * t);
    link.run_for(drive_step);
    if (k < 500) continue;
    const double wanted = amplitude * std::sin(rate * (t + drive_step - period));
    worst = std::max(worst, std::abs(link.of(keys::joint_position) - wanted));
  }
  return {worst, text(worst) + " rad off"};
}

/// Checks drives of wheels that write velocities, while position targets do not change. A joint stands where stiffness
/// and damping pull equally, at damping / stiffness times the velocity.
Outcome commanded_velocity(const std::string& motion) {
  Trial t(motion);
  t.set_gravity(Vec3::Zero());
  const RobotTree rover = test::rover({.wheel_inertia = test::round_body(0.3, 0.06)}, 0.8);
  const RobotView& r = t.add("r", rover, {{0, 0, 1}, Quat::Identity()});
  t.use("drive.skid_steer", 0, t.all_robots());
  t.start({{"base", "fixed"}, {"joints", "position"}, {"natural_frequency", 50.0}});
  t.world().value(r.base(), keys::command_twist).linear.x() = 0.3;
  t.run_for(2);
  const double expected = 2 * (0.3 / 0.06) / 50;
  const Outcome left = relative(t.joint("r/front_left_joint", keys::joint_position), expected),
                right = relative(t.joint("r/rear_right_joint", keys::joint_position), expected);
  return {std::max(left.error, right.error), left.seen + "; " + right.seen};
}

/// Two links in a vertical plane.
struct TwoLinks : Trial {
  static constexpr double first = 2, second = 1, length = 0.5, first_com = 0.25, second_com = 0.2;

  explicit TwoLinks(const std::string& motion) : Trial(motion) {
    add("r", test::tree_of([](RobotBuilder& b) {
          const auto rod = [&](double kilograms, double com) {
            b.set(keys::inertial,
                  Inertia{.mass = kilograms, .com = {com, 0, 0}, .ixx = 0.01, .iyy = 0.03, .izz = 0.03});
          };
          b.base("base");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("shoulder", Vec3::UnitY(), {});
          b.body("upper");
          rod(first, first_com);
          b.translation({length, 0, 0});
          b.revolute("elbow", Vec3::UnitY(), {});
          b.body("lower");
          rod(second, second_com);
        }),
        {{0, 0, 1}, Quat::Identity()});
    start({{"base", "fixed"}, {"joints", "position"}, {"interpolate", 0.01}});
  }
  double& of(const char* name, const Key<double>& key) { return joint(std::string("r/") + name, key); }

  /// Returns the efforts of inverse dynamics at the present position and speed, without acceleration (Spong, Hutchinson
  /// and Vidyasagar, Robot Modeling and Control, 7.4); angles count downwards.
  std::array<double, 2> efforts() {
    const double q1 = of("shoulder", keys::joint_position), q2 = of("elbow", keys::joint_position);
    const double v1 = of("shoulder", keys::joint_velocity), v2 = of("elbow", keys::joint_velocity);
    const double h = -second * length * second_com * std::sin(q2);
    const double lower = second * second_com * std::cos(q1 + q2) * g;
    const double upper = (first * first_com + second * length) * std::cos(q1) * g + lower;
    return {h * (2 * v1 * v2 + v2 * v2) - upper, -h * v1 * v1 - lower};
  }
};

/// Checks an arm moved steadily by a controller of 100 Hz: inverse dynamics gives its efforts in every drive_step.
Outcome steady_arm(const std::string& motion) {
  TwoLinks arm(motion);
  double worst = 0, largest = 0;
  for (int k = 0; k < 1000; ++k) {
    if (k % 10 == 0) {
      arm.of("shoulder", keys::joint_position_target) = 0.6 * k * drive_step;
      arm.of("elbow", keys::joint_position_target) = -0.4 * k * drive_step;
    }
    arm.run_for(drive_step);
    if (k < 300) continue;
    const auto [shoulder, elbow] = arm.efforts();
    largest = std::max(largest, std::abs(shoulder));
    worst = std::max({worst, std::abs(arm.of("shoulder", keys::joint_effort) - shoulder),
                      std::abs(arm.of("elbow", keys::joint_effort) - elbow)});
  }
  return {worst / largest, text(worst) + " of " + text(largest) + " N m"};
}

Outcome drive_snapshot(const std::string& motion) {
  TwoLinks arm(motion);
  const auto go_on = [&] {
    arm.of("elbow", keys::joint_position_target) = 0.3;
    arm.run_for(0.004);
    arm.of("shoulder", keys::joint_position_target) = -0.2;
    arm.run_for(0.1);
    return arm.state_hash();
  };
  arm.of("shoulder", keys::joint_position_target) = 0.1;
  arm.run_for(0.053);
  arm.of("elbow", keys::joint_position_target) = -0.1;
  arm.run_for(0.004);
  const Snapshot middle = arm.snapshot();
  const std::uint64_t once = go_on();
  arm.restore(middle);
  return {once == go_on() ? 0.0 : 1.0, "the hash of the state"};
}

}  // namespace

std::vector<Case> position_drive_cases() {
  constexpr Features needs = feature_fixed_base | feature_position_targets | feature_forces;
  return {
      {"a position drive goes to its target as an oscillator", "relative", needs, 1.5e-2, drive_step_response},
      {"a position drive overshoots as its gains say", "relative", needs, 1e-2, drive_overshoot},
      {"a position drive moves its rotor as it moves the link", "relative", needs | feature_armature, 1e-2,
       drive_rotor},
      {"gains of a position drive count the rotor in", "relative", needs | feature_armature, 1.5e-2,
       drive_rotor_frequency},
      {"a position drive gives way to a load by its stiffness", "relative", needs, 1e-3, drive_deflection},
      {"a position drive is stable however stiff", "rad, rad/s", needs, 1e-4, drive_stiff},
      {"Coulomb friction acts beside a position drive", "rad, relative", needs | feature_joint_friction, 1e-3,
       drive_friction},
      {"a position drive is no stronger than its limit", "relative", needs | feature_joint_effort_limits, 1e-6,
       drive_effort_limit},
      {"a position drive is no faster than its limit", "relative", needs | feature_joint_speed_limits, 1e-3,
       drive_speed_limit},
      {"a position drive follows an interpolated sine", "rad", needs, 2e-3, sine},
      {"a commanded velocity adds to a position drive", "relative", needs, 1e-6, commanded_velocity},
      {"efforts of a steady arm are those of inverse dynamics", "relative", needs, 1e-2, steady_arm},
      {"an interpolated target goes on from a snapshot", "1", needs, 0, drive_snapshot},
  };
}

}  // namespace muro::conformance
