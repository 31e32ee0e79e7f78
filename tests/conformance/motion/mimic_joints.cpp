// SPDX-License-Identifier: MIT
// Joints that follow others: q = multiplier times q of the leader.
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

/// Two joints about y on one base, each with a link whose centre of mass the test chooses.
struct MimicPair : Trial {
  MimicPair(const std::string& motion, double multiplier, const Inertia& first, const Inertia& second,
            const JointLimits& limits = {})
      : Trial(motion) {
    add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("base");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.fork();
          b.revolute("leader", Vec3::UnitY(), {});
          b.body("first");
          b.set(keys::inertial, first);
          b.end();
          b.translation({0, 1, 0});
          b.revolute("follower", Vec3::UnitY(), limits);
          b.mimic("leader", multiplier, 0);
          b.body("second");
          b.set(keys::inertial, second);
          b.end();
        }),
        {{0, 0, 3}, Quat::Identity()});
  }
  double position(const std::string& name) { return joint("r/" + name, keys::joint_position); }
  double velocity(const std::string& name) { return joint("r/" + name, keys::joint_velocity); }
  /// Returns the distance of the follower from its position by the leader, rad.
  double lag(double multiplier) { return std::abs(position("follower") - multiplier * position("leader")); }
};

const Inertia balanced{.mass = 1, .ixx = 0.1, .iyy = 0.1, .izz = 0.1};
constexpr double arm_length = 0.5;  ///< m, of arms
const Inertia hanging{.mass = 1, .com = {0, 0, -arm_length}, .ixx = 0.01, .iyy = 0.01, .izz = 0.01};
const Inertia level{.mass = 1, .com = {arm_length, 0, 0}, .ixx = 0.01, .iyy = 0.01, .izz = 0.01};

Outcome follows_leader(const std::string& motion) {
  MimicPair p(motion, -0.5, balanced, balanced);
  p.set_gravity(Vec3::Zero());
  p.start({{"base", "fixed"}});
  p.joint("r/leader", keys::joint_velocity_target) = 1;
  p.run_for(2);
  return {p.lag(-0.5), text(p.position("follower")) + " for " + text(-0.5 * p.position("leader"))};
}

/// Checks a leader that swings with its follower: I q'^2 / 2 = m g l (1 - cos q), sums of both, the follower with k q.
Outcome swings(const std::string& motion) {
  constexpr double k = -2, from = 0.6, inertia = 0.01 + arm_length * arm_length;
  MimicPair p(motion, k, hanging, hanging);
  p.world().set(p.world().object("r/leader"), keys::initial_joint_position, from);
  p.start({{"base", "fixed"}, {"joints", "passive"}});
  double fastest = 0, lag = 0;
  for (int i = 0; i < 1500; ++i) {
    p.run_for(0.001);
    fastest = std::max(fastest, std::abs(p.velocity("leader")));
    lag = std::max(lag, p.lag(k));
  }
  const double work = g * arm_length * (2 - std::cos(from) - std::cos(k * from));
  const Outcome speed = relative(fastest, std::sqrt(2 * work / (inertia * (1 + k * k))));
  return {std::max(speed.error, lag), speed.seen + " rad/s, " + text(lag) + " rad off"};
}

/// Checks the load of the follower on the leader's drive, by the multiplier: k m g l cos(k q) = stiffness times sag.
Outcome sags(const std::string& motion) {
  constexpr double k = 0.5;
  MimicPair p(motion, k, balanced, level);
  p.start({{"base", "fixed"},
           {"joints", "position"},
           {"stiffness", std::vector<std::string>{"40"}},
           {"damping", std::vector<std::string>{"8"}}});
  p.run_for(4);
  const double sag = p.position("leader");
  const Outcome balance = relative(sag, k * g * arm_length * std::cos(k * sag) / 40);
  return {std::max(balance.error, p.lag(k)), balance.seen + " rad"};
}

/// Checks that limits of the follower itself do not hold it.
Outcome passes_limits(const std::string& motion) {
  MimicPair p(motion, -1, balanced, balanced, {.lower = 0, .upper = 0.88});
  p.set_gravity(Vec3::Zero());
  p.start({{"base", "fixed"}, {"joints", "position"}});
  p.joint("r/leader", keys::joint_position_target) = 0.7;
  p.run_for(2);
  const double leader = p.position("leader"), follower = p.position("follower");
  return {std::abs(leader - 0.7) + std::abs(follower + 0.7), text(leader) + " and " + text(follower)};
}

}  // namespace

std::vector<Case> mimic_joint_cases() {
  constexpr Features mimics = feature_joints | feature_mimic_joints, fixed = mimics | feature_fixed_base;
  return {
      {"a mimic joint follows its leader", "rad", fixed, 1e-3, follows_leader},
      {"a leader swings with what its mimic carries", "relative, rad", fixed | feature_forces, 2e-3, swings},
      {"a leader sags under what its mimic carries", "relative, rad", fixed | feature_forces | feature_position_targets,
       1e-3, sags},
      {"a mimic joint goes where its leader takes it", "rad", fixed | feature_position_targets, 1e-3, passes_limits},
      {"a mimic joint without forces goes there, too", "rad", mimics | feature_position_targets, 1e-3, passes_limits,
       "motion.point"},
  };
}

}  // namespace muro::conformance
