// SPDX-License-Identifier: MIT
// Arms without mass on a base that is fixed to the world: their joints follow their targets, and no force moves them.
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

constexpr double turn_speed = 0.4, upper = 0.5;  ///< of the first joint, rad/s and rad

/// Returns an arm with a turning joint, one that mimics it with an `offset` (rad), and a sliding one. The last link has
/// a shape, 0.6 m from the base.
RobotTree arm(double offset) {
  return test::tree_of([offset](RobotBuilder& b) {
    b.base("base");
    b.revolute("turn", Vec3::UnitZ(), {.lower = -1, .upper = upper, .velocity = turn_speed});
    b.body("upper");
    b.translation({0.3, 0, 0});
    b.revolute("elbow", Vec3::UnitZ(), {});
    b.mimic("turn", -2, offset);
    b.body("lower");
    b.translation({0.3, 0, 0});
    b.prismatic("slide", Vec3::UnitX(), {.lower = 0, .upper = 2, .velocity = 0.25});
    b.body("hand");
    const Shape palm = Shape::box({0.1, 0.1, 0.2});
    b.set_array(keys::collision_shapes, std::span<const Shape>(&palm, 1));
  });
}

struct Arm : Trial {
  explicit Arm(const std::string& motion, const std::string& mode) : Trial(motion) {
    add("r", arm(0.1), {{0, 0, 1}, Quat::Identity()});
    set_log([this](LogLevel, std::string_view text) { said += std::string(text) + "\n"; });
    start({{"base", "fixed"}, {"joints", mode}, {"max_joint_acceleration", 1e9}});
  }
  double of(const char* name) { return joint(name, keys::joint_position); }
  std::string said;
};

/// Returns the largest error of the joints within two seconds.
template <class Turn, class Slide>
Outcome compared(Arm& a, Turn turn, Slide slide) {
  double worst = 0;
  for (int k = 0; k <= 100; ++k) {
    const double t = 1e-9 * double(a.now());
    worst = std::max({worst, std::abs(a.of("r/turn") - turn(t)), std::abs(a.of("r/slide") - slide(t)),
                      std::abs(a.of("r/elbow") - (0.1 - 2 * turn(t))) / 2});
    a.run_for(0.02);
  }
  return {worst, text(worst) + " rad or m"};
}

Outcome ramps(const std::string& motion) {
  Arm a(motion, "position");
  a.joint("r/turn", keys::joint_position_target) = 0.3;
  a.joint("r/slide", keys::joint_position_target) = 1;
  return compared(
      a, [](double t) { return std::min(0.3, turn_speed * t); }, [](double t) { return std::min(1.0, 0.25 * t); });
}

Outcome massless_joints_stop(const std::string& motion) {
  Arm a(motion, "position");
  a.joint("r/turn", keys::joint_position_target) = 3;
  a.joint("r/slide", keys::joint_position_target) = -1;
  return compared(
      a, [](double t) { return std::min(upper, turn_speed * t); }, [](double) { return 0.0; });
}

Outcome integrates(const std::string& motion) {
  Arm a(motion, "velocity");
  a.joint("r/turn", keys::joint_velocity_target) = 10;  // cut at its velocity limit, and stopped at its position limit
  a.joint("r/slide", keys::joint_velocity_target) = 0.2;
  return compared(
      a, [](double t) { return std::min(upper, turn_speed * t); }, [](double t) { return 0.2 * t; });
}

Outcome massless_base_stays(const std::string& motion) {
  Arm a(motion, "position");
  Pose& base = a.pose(*a.world().robots()[0]);
  const Pose before = base;
  a.joint("r/turn", keys::joint_position_target) = 0.3;
  a.run_for(1);
  const double moved = (base.position - before.position).norm() + base.orientation.angularDistance(before.orientation);
  return {moved, text(moved) + " m, rad"};
}

Outcome tells_once(const std::string& motion) {
  Arm a(motion, "position");
  const std::string expected =
      "no link that moves has mass: `r`; joints follow their targets within limits, without forces (`muro check` says "
      "what models lack)\n";
  a.run_for(0.1);
  return {a.said.ends_with(expected) && std::count(a.said.begin(), a.said.end(), '\n') == 1 ? 0.0 : 1.0, a.said};
}

/// Checks an arm without mass that pushes a box over the ground. The same motion moves the box, in one world where the
/// motion has worlds.
Outcome massless_arm_pushes(const std::string& motion) {
  Trial t(motion);
  t.add_ground(0.3);
  const RobotView& r = t.add("r", arm(0), {{0, 0, 0.15}, Quat::Identity()});
  const RobotView& box = t.add("box", block(2, {0.2, 0.2, 0.2}, 0.3), {{0.8, 0, 0.1}, Quat::Identity()});
  t.use(motion, 1000, {{&r, r.base()}}, {{"base", "fixed"}, {"joints", "position"}});
  t.use(motion, 1000, {{&box, box.base()}});
  t.use_contacts();
  t.build();
  // the front of the palm moves from 0.65 m to 1.65 m at 0.25 m/s; the box is at 0.7 m
  t.joint("r/slide", keys::joint_position_target) = 1;
  t.run_for(3);
  const double gap = t.pose(box).position.x() - 0.1 - (0.65 + t.joint("r/slide", keys::joint_position));
  const double v = t.twist(box).linear.x();
  return {std::max(std::abs(v - 0.25), std::abs(gap)), text(v) + " m/s for 0.25, gap " + text(gap) + " m"};
}

}  // namespace

std::vector<Case> massless_arm_cases() {
  constexpr Features fixed = feature_fixed_base | feature_position_targets | feature_velocity_targets;
  std::vector<Case> all = {
      {"that no force moves an arm is said once", "messages", fixed, 0, tells_once},
      {"an arm without mass pushes what it meets", "m/s, m", fixed | feature_contact | feature_friction, 5e-3,
       massless_arm_pushes},
  };
  constexpr struct {
    std::string_view name, unit;
    double bound;
    Outcome (*run)(const std::string& motion);
  } of_joints[] = {
      {"joints without mass go to their targets at their limits of speed", "rad, m", 1e-9, ramps},
      {"joints without mass stop at their limits of position", "rad, m", 1e-9, massless_joints_stop},
      {"joints without mass integrate targets of velocity", "rad, m", 1e-9, integrates},
      {"a base without mass stays where it is fixed", "m, rad", 1e-12, massless_base_stays},
  };
  for (const auto& c : of_joints) {
    all.push_back({c.name, c.unit, fixed, c.bound, c.run});
    all.push_back({c.name, c.unit, 0, c.bound, c.run, "motion.point"});
  }
  return all;
}

}  // namespace muro::conformance
