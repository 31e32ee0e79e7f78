// SPDX-License-Identifier: MIT
// One joint on a base that is fixed to the world, unless a case says otherwise.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

constexpr double moment = 0.1;  ///< kg m^2, of the link about a revolute joint
constexpr double mass = 1;      ///< kg, of the link

/// Returns a link with its centre of mass on the joint, which turns about z or slides along x.
RobotTree one_joint(JointKind kind, const JointLimits& limits) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("base");
    b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
    if (kind == JointKind::revolute)
      b.revolute("joint", Vec3::UnitZ(), limits);
    else
      b.prismatic("joint", Vec3::UnitX(), limits);
    b.body("link");
    b.set(keys::inertial, Inertia{.mass = mass, .ixx = moment, .iyy = moment, .izz = moment});
  });
}

struct Joint : Trial {
  Joint(const std::string& motion, const std::string& mode, const JointLimits& limits,
        JointKind kind = JointKind::revolute, const std::string& base = "fixed")
      : Trial(motion) {
    set_gravity(Vec3::Zero());
    add("r", one_joint(kind, limits), {{0, 0, 1}, Quat::Identity()});
    start({{"base", base}, {"joints", mode}, {"effort_limits", true}});
  }
  double& of(const Key<double>& key) { return joint("r/joint", key); }
};

Outcome velocity(const std::string& motion) {
  Joint j(motion, "velocity", {});
  j.of(keys::joint_velocity_target) = 2;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 2);
}

Outcome turns(const std::string& motion) {
  Joint j(motion, "velocity", {});
  j.of(keys::joint_velocity_target) = 10;
  j.run_for(1);
  const double before = j.of(keys::joint_position);
  j.run_for(3);
  return relative(j.of(keys::joint_position) - before, 30);
}

Outcome slow_drive(const std::string& motion) {
  Joint j(motion, "velocity", {.effort = 0.05});
  j.of(keys::joint_velocity_target) = 5;
  j.run_for(2);
  return relative(j.of(keys::joint_velocity), 2 * 0.05 / moment);
}

Outcome speed_limit(const std::string& motion) {
  Joint j(motion, "velocity", {.velocity = 1.5});
  j.of(keys::joint_velocity_target) = 4;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 1.5);
}

/// An arm of 1 kg, 0.5 m long, that a drive holds 0.5 rad below the horizontal.
struct HeldArm : Trial {
  explicit HeldArm(const std::string& motion) : Trial(motion) {
    add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("joint", Vec3::UnitY(), {});
          b.body("arm");
          b.set(keys::inertial, Inertia{.mass = 1, .com = {0.5, 0, 0}, .ixx = 0.01, .iyy = 0.01, .izz = 0.01});
        }),
        {{0, 0, 1}, Quat::Identity()});
    start({{"base", "fixed"}, {"joints", "position"}});
    joint("r/joint", keys::joint_position_target) = 0.5;
    run_for(2);
  }
};

Outcome holds(const std::string& motion) {
  HeldArm arm(motion);
  const double q = arm.joint("r/joint", keys::joint_position);
  return {std::abs(q - 0.5), text(q) + " for 0.5"};
}

Outcome tells_effort(const std::string& motion) {
  HeldArm arm(motion);
  return relative(arm.joint("r/joint", keys::joint_effort), -g * 0.5 * std::cos(0.5));
}

Outcome effort(const std::string& motion) {
  Joint j(motion, "effort", {});
  j.of(keys::joint_effort_target) = 0.2;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 0.2 / moment);
}

Outcome fast_effort(const std::string& motion) {
  Joint j(motion, "effort", {.velocity = 1.5});
  j.of(keys::joint_effort_target) = 0.2;
  j.run_for(2);
  return relative(j.of(keys::joint_velocity), 1.5);
}

Outcome slider(const std::string& motion) {
  Joint j(motion, "effort", {}, JointKind::prismatic);
  j.of(keys::joint_effort_target) = 2;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 2 / mass);
}

Outcome effort_limit(const std::string& motion) {
  Joint j(motion, "effort", {.effort = 0.05});
  j.of(keys::joint_effort_target) = 0.2;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 0.05 / moment);
}

Outcome damping(const std::string& motion) {
  Joint j(motion, "passive", {.damping = 0.2});
  j.of(keys::joint_velocity) = 3;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 3 * std::exp(-0.2 / moment));
}

Outcome strong_damping(const std::string& motion) {
  Joint j(motion, "passive", {.damping = 1e4});
  j.of(keys::joint_velocity) = 3;
  j.run_for(0.1);
  return {std::abs(j.of(keys::joint_velocity)), text(j.of(keys::joint_velocity)) + " rad/s"};
}

Outcome friction_slows(const std::string& motion) {
  Joint j(motion, "passive", {.friction = 0.1});
  j.of(keys::joint_velocity) = 3;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 3 - 0.1 / moment);
}

Outcome friction_holds(const std::string& motion) {
  Joint j(motion, "effort", {.friction = 0.1});
  j.of(keys::joint_effort_target) = 0.09;
  j.run_for(1);
  return {std::abs(j.of(keys::joint_position)), text(j.of(keys::joint_position)) + " rad"};
}

Outcome stop(const std::string& motion) {
  Joint j(motion, "effort", {.lower = -1, .upper = 0.5});
  j.of(keys::joint_effort_target) = 0.2;
  double farthest = 0;
  for (int k = 0; k < 200; ++k) {
    j.run_for(0.01);
    farthest = std::max(farthest, j.of(keys::joint_position));
  }
  return {std::abs(farthest - 0.5), text(farthest) + " for 0.5"};
}

Outcome far_stop(const std::string& motion) {
  Joint j(motion, "effort", {.lower = -6, .upper = 6});
  j.of(keys::joint_effort_target) = 0.2;
  double farthest = 0;
  for (int k = 0; k < 400; ++k) {
    j.run_for(0.01);
    farthest = std::max(farthest, j.of(keys::joint_position));
  }
  return {std::abs(farthest - 6), text(farthest) + " for 6"};
}

Outcome armature(const std::string& motion) {
  Joint j(motion, "effort", {.armature = 0.3});
  j.of(keys::joint_effort_target) = 0.2;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 0.2 / (moment + 0.3));
}

Outcome sliding_armature(const std::string& motion) {
  Joint j(motion, "effort", {.armature = 4}, JointKind::prismatic);
  j.of(keys::joint_effort_target) = 2;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 2 / (mass + 4));
}

/// Checks that a drive that holds a speed accelerates its own rotor as well.
Outcome driven_armature(const std::string& motion) {
  Joint j(motion, "velocity", {.effort = 0.05, .armature = 0.3});
  j.of(keys::joint_velocity_target) = 5;
  j.run_for(2);
  return relative(j.of(keys::joint_velocity), 2 * 0.05 / (moment + 0.3));
}

Outcome damped_armature(const std::string& motion) {
  Joint j(motion, "passive", {.damping = 0.2, .armature = 0.3});
  j.of(keys::joint_velocity) = 3;
  j.run_for(1);
  return relative(j.of(keys::joint_velocity), 3 * std::exp(-0.2 / (moment + 0.3)));
}

/// Checks that the rotor exerts no torque on the base. With the moments B and I of base and link, q'' = e / (I +
/// armature - I^2 / (B + I)), and the base turns back by I q'' / (B + I).
Outcome reaction_with_armature(const std::string& motion) {
  Joint j(motion, "effort", {.armature = 0.3}, JointKind::revolute, "free");
  j.of(keys::joint_effort_target) = 0.2;
  j.run_for(1);
  const double expected = 0.2 / (moment + 0.3 - moment * moment / (1 + moment));
  const Outcome link = relative(j.of(keys::joint_velocity), expected),
                base = relative(j.world().value("r/base", keys::twist).angular.z(), -moment / (1 + moment) * expected);
  return {std::max(link.error, base.error), link.seen + "; " + base.seen};
}

/// Checks that the base of a free robot turns against its link: momentum stays 0.
Outcome reaction(const std::string& motion) {
  Joint j(motion, "velocity", {}, JointKind::revolute, "free");
  j.of(keys::joint_velocity_target) = 2;
  j.run_for(1);
  const double base = j.world().value("r/base", keys::twist).angular.z();
  return relative(base, -2 * moment / (1 + moment));
}

Outcome stays(const std::string& motion) {
  Trial t(motion);
  const RobotView& r = t.add("r", one_joint(JointKind::revolute, {}), {{1, 2, 3}, from_rpy(0.1, 0.2, 0.3)});
  Wrench& w = t.push(r);
  t.start({{"base", "fixed"}});
  w = {{10, 20, 30}, {1, 2, 3}};
  t.joint("r/joint", keys::joint_velocity_target) = 3;
  const Pose before = t.pose(r);
  t.run_for(1);
  const double moved = (t.pose(r).position - before.position).norm() +
                       t.pose(r).orientation.angularDistance(before.orientation) + t.twist(r).linear.norm();
  return {moved, text(moved) + " m"};
}

}  // namespace

std::vector<Case> joint_cases() {
  constexpr Features fixed = feature_fixed_base | feature_joints;
  return {
      {"a driven joint reaches its speed", "relative", fixed | feature_velocity_targets, 1e-6, velocity},
      {"a joint counts whole turns", "relative", fixed | feature_velocity_targets, 1e-6, turns},
      {"a drive is no stronger than its effort limit", "relative",
       fixed | feature_velocity_targets | feature_joint_effort_limits, 1e-3, slow_drive},
      {"a drive is no faster than its limit of velocity", "relative",
       fixed | feature_velocity_targets | feature_joint_speed_limits, 1e-6, speed_limit},
      {"a position drive holds an arm against gravity", "rad", fixed | feature_position_targets, 2e-3, holds},
      {"a drive tells with what effort it holds an arm", "relative", fixed | feature_position_targets | feature_forces,
       1e-2, tells_effort},
      {"an effort turns a link as its inertia says", "relative", fixed | feature_effort_targets, 1e-6, effort},
      {"a rotor resists as an inertia at the joint", "relative", fixed | feature_effort_targets | feature_armature,
       1e-6, armature},
      {"a rotor resists as a mass at a joint that slides", "relative",
       fixed | feature_effort_targets | feature_armature, 1e-6, sliding_armature},
      {"a drive speeds up its rotor with its effort limit", "relative",
       fixed | feature_velocity_targets | feature_joint_effort_limits | feature_armature, 1e-3, driven_armature},
      {"damping slows a link and its rotor exponentially", "relative", fixed | feature_joint_damping | feature_armature,
       5e-3, damped_armature},
      {"a free base feels the link and not its rotor", "relative",
       feature_link_dynamics | feature_effort_targets | feature_forces | feature_armature, 1e-4,
       reaction_with_armature},
      {"an effort shifts a link as its mass says", "relative", fixed | feature_effort_targets, 1e-6, slider},
      {"an effort is cut at the limit of the model", "relative",
       fixed | feature_effort_targets | feature_joint_effort_limits, 1e-6, effort_limit},
      {"an effort pushes a joint no faster than its limit", "relative",
       fixed | feature_effort_targets | feature_joint_speed_limits, 1e-6, fast_effort},
      {"damping slows a link exponentially", "relative", fixed | feature_joint_damping, 5e-3, damping},
      {"damping far beyond the step is stable", "rad/s", fixed | feature_joint_damping, 1e-3, strong_damping},
      {"Coulomb friction slows a link evenly", "relative", fixed | feature_joint_friction, 1e-3, friction_slows},
      {"Coulomb friction holds a link below its limit", "rad", fixed | feature_joint_friction | feature_effort_targets,
       1e-4, friction_holds},
      {"a joint stops at its limit", "rad", fixed | feature_joint_limits | feature_effort_targets, 5e-3, stop},
      {"a joint stops at a limit of nearly a turn", "rad", fixed | feature_joint_limits | feature_effort_targets, 1e-2,
       far_stop},
      {"a free base turns against its link", "relative",
       feature_link_dynamics | feature_velocity_targets | feature_forces, 1e-4, reaction},
      {"a fixed base stays whatever acts on it", "m, rad, m/s", fixed, 1e-12, stays},
  };
}

}  // namespace muro::conformance
