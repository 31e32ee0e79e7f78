// SPDX-License-Identifier: MIT
// Chains of joints without drives and contacts, compared with the solution of their equations: all digits that are
// given are those of the method of Runge and Kutta at 16 kHz.
#include <functional>

#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

/// Returns the inertia of a slender body that hangs from its joint.
Inertia rod(double mass, double length) {
  const double across = mass * length * length / 12;
  return {.mass = mass, .com = {0, 0, -length / 2}, .ixx = across, .iyy = across, .izz = 0.12 * across};
}

/// Returns `count` bodies, each `length` (m) below the one before. `axes` of their joints repeat.
RobotTree chain(int count, double length, std::initializer_list<Vec3> axes, const std::function<double(int)>& mass) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("base");
    b.set(keys::inertial, Inertia{.mass = 5, .ixx = 0.1, .iyy = 0.1, .izz = 0.1});
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i);
      b.revolute("joint" + number, axes.begin()[std::size_t(i) % axes.size()], {});
      b.body("body" + number);
      b.set(keys::inertial, rod(mass(i), length));
      b.translation({0, 0, -length});
    }
  });
}
RobotTree arm(int count) {
  return chain(count, 0.3, {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()}, [](int i) { return 2.0 / (i + 1); });
}
RobotTree rope() {
  return chain(10, 0.2, {Vec3::UnitY(), Vec3::UnitX()}, [](int) { return 0.5; });
}

/// Returns the largest error of a joint (rad) `seconds` after the start.
Outcome swing(const std::string& motion, const RobotTree& tree, bool fixed, double width, double seconds,
              std::initializer_list<double> expected) {
  Trial t(motion);
  if (!fixed) t.set_gravity(Vec3::Zero());
  t.add("r", tree, {{0, 0, 5}, Quat::Identity()}, fixed ? Twist{} : Twist{{0.5, 0.2, 1}, {1, -2, 1.5}});
  const auto name = [](std::size_t i) { return "r/joint" + std::to_string(i); };
  for (std::size_t i = 0; i < expected.size(); ++i)
    t.world().set(t.world().object(name(i)), keys::initial_joint_position, width * std::sin(1 + 2.1 * double(i)));
  t.start({{"base", fixed ? "fixed" : "free"}, {"joints", "passive"}});
  t.run_for(seconds);
  double worst = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    worst = std::max(worst, std::abs(t.joint(name(i), keys::joint_position) - expected.begin()[i]));
  return {worst, text(worst) + " rad off"};
}

Outcome six_joints(const std::string& motion) {
  return swing(motion, arm(6), true, 1, 2, {6.62597613, -0.23423702, -0.74150306, 5.57843390, -0.45336538, 0.73524320});
}
Outcome ten_links(const std::string& motion) {
  return swing(motion, rope(), true, 0.5, 2,
               {-0.00961971, 0.05894268, 0.19790538, 0.23694978, 0.14158264, -0.11741707, -0.26032232, -0.21400515,
                -0.49067960, -1.50339071});
}
Outcome in_flight(const std::string& motion) {
  return swing(motion, arm(3), false, 0.5, 2, {0.59910848, 0.02470917, -0.08304830});
}

}  // namespace

std::vector<Case> swing_cases() {
  constexpr Features needs =
      feature_fixed_base | feature_joints | feature_forces | feature_joint_friction | feature_link_dynamics;
  return {
      {"an arm of six joints swings as its equations say", "rad", needs, 0.05, six_joints},
      {"a chain of ten links swings as its equations say", "rad", needs, 5e-3, ten_links},
      {"an arm in flight swings as its equations say", "rad", needs, 1e-3, in_flight},
  };
}

}  // namespace muro::conformance
