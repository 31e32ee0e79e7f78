// SPDX-License-Identifier: MIT
// Parts that two fingers hold by friction alone, and friction cones.
#include "tests/conformance/motion/case.hpp"
#include "tests/conformance/motion/recorded_contacts.hpp"

namespace muro::conformance {

namespace {

constexpr double grip_effort = 20;                       ///< N, of each finger
constexpr double grip_friction = 0.5;                    ///< both fingers hold 2 mu N / g = 2.04 kg
constexpr double pad_size = 0.04, pad_thickness = 0.02;  ///< m
constexpr double part_width = 0.06;                      ///< m: between the pads

/// Returns two fingers on a base that slide along y towards each other. With joints at 0 they are `part_width` apart.
RobotTree gripper() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("palm");
    b.set(keys::inertial, solid_box(2, {0.2, 0.2, 0.05}));
    const Shape shape = with(Shape::box({pad_size, pad_thickness, pad_size}), grip_friction);
    for (const double side : {-1.0, 1.0}) {
      const std::string name = side < 0 ? "right" : "left";
      if (side < 0) b.fork();
      b.translation({0, side * 0.5 * (part_width + pad_thickness), -0.1});
      b.prismatic(name, Vec3(0, -side, 0), {.velocity = 1, .effort = grip_effort});
      b.body(name + "_finger");
      b.set(keys::inertial, solid_box(0.2, {pad_size, pad_thickness, pad_size}));
      b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
      b.end();
    }
  });
}

struct Grip : Trial {
  const RobotView* part = nullptr;
  /// Puts the middle of the part `off` (m, along the pads) away from that of the pads.
  Grip(const std::string& motion, double mass, double off) : Trial(motion) {
    add("gripper", gripper(), {{0, 0, 1}, Quat::Identity()});
    std::map<std::string, ParameterInput> parameters{{"base", std::string("fixed")}};
    if (motion == "motion.simplified") parameters.emplace("effort_limits", true);
    use(motion, 1000, all_robots(), parameters);
    part = &add("part", block(mass, {0.08, part_width, 0.06}, grip_friction), {{off, 0, 0.9}, Quat::Identity()});
    use(motion, 1000, {all_robots().back()});
    use_contacts();
  }
  void begin() {
    build();
    for (const char* joint_name : {"gripper/right", "gripper/left"})
      joint(joint_name, keys::joint_velocity_target) = 0.05;
  }
};

/// Returns the depth (m) of a finger in a wall that it presses with `effort` (N); finger and slide have 0.3 kg.
double pressed(const std::string& motion, double effort, double rate) {
  Trial t(motion, rate);
  const Vec3 size(0.04, 0.04, 0.04);
  const Shape wall = with(Shape::box({0.2, 1, 1}), grip_friction);
  t.world().add_scenery("wall", {{0.1 + 0.5 * size.x() + 0.1, 0, 1}, Quat::Identity()},
                        std::span<const Shape>(&wall, 1));
  const Shape shape = with(Shape::box(size), grip_friction);
  t.add("press", test::tree_of([&](RobotBuilder& b) {
          b.base("frame");
          b.set(keys::inertial, solid_box(0.2, {0.1, 0.1, 0.1}));
          b.prismatic("slide", Vec3::UnitX(), {.velocity = 1, .effort = effort});
          b.body("finger");
          b.set(keys::inertial, solid_box(0.1, size));
          b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
        }),
        {{0, 0, 1}, Quat::Identity()});
  std::map<std::string, ParameterInput> parameters{{"base", std::string("fixed")}};
  if (motion == "motion.simplified") parameters.emplace("effort_limits", true);
  t.start(parameters);
  t.joint("press/slide", keys::joint_velocity_target) = 0.2;
  t.run_for(4);
  return std::abs(t.joint("press/slide", keys::joint_position) - 0.1);
}
Outcome press(const std::string& motion) {
  Outcome worst;
  for (const double rate : {1000.0, 250.0})
    for (const double effort : {3.0, 60.0}) {
      const double depth = pressed(motion, effort, rate);
      if (depth > worst.error) worst = {depth, text(depth) + " m with " + text(effort) + " N at " + text(rate) + " Hz"};
    }
  return worst;
}

/// Motion and rotation of the part within 5 s after the fingers have closed, as a fraction of what is allowed.
Outcome holds_part(const std::string& motion) {
  constexpr double may_move = 1e-4, may_turn = 0.01;
  double worst = 0;
  std::string seen;
  for (const double mass : {1.4, 1.8})
    for (const double off : {0.0, 0.004}) {
      Grip trial(motion, mass, off);
      trial.begin();
      trial.run_for(0.5);
      const Pose before = trial.pose(*trial.part);
      trial.run_for(5);
      const Pose after = trial.pose(*trial.part);
      const double moved = (after.position - before.position).norm(),
                   turned = before.orientation.angularDistance(after.orientation), sunk = 0.9 - before.position.z();
      worst = std::max({worst, moved / may_move, turned / may_turn, sunk / 2e-3});
      seen += (seen.empty() ? "" : "; ") + text(mass) + " kg, " + text(off) + " m off: " + text(moved) + " m, " +
              text(turned) + " rad, after " + text(sunk) + " m";
    }
  return {worst, seen};
}

Outcome drops_part(const std::string& motion) {
  Grip trial(motion, 2.3, 0);
  trial.begin();
  trial.run_for(1);
  const double fallen = 0.9 - trial.pose(*trial.part).position.z();
  return {fallen > 0.1 ? 0.0 : 1.0, text(fallen) + " m in 1 s"};
}

/// Returns the largest tangential force beyond the friction cone of a recorded contact, as a fraction of its limit. The
/// limit is that of the normal force, or of `least` (N) if the normal force is smaller.
double out_of_cone(Trial& trial, const std::function<void()>& run, double least) {
  double worst = 0;
  for (const RecordedContact& c : recorded_contacts(trial, run)) {
    const double pressure = c.force.dot(c.normal), tangential = (c.force - c.normal * pressure).norm();
    worst = std::max(worst, (tangential - grip_friction * pressure) / (grip_friction * std::max(pressure, least)));
  }
  return worst;
}

/// Checks bodies that slide and spin, roll while they slip, or tumble, and a part that is held.
Outcome stays_in_cones(const std::string& motion) {
  Trial moving(motion);
  moving.add_ground(grip_friction);
  moving.add("slides", block(1, {0.2, 0.2, 0.1}, grip_friction), {{0, 0, 0.05}, Quat::Identity()},
             {{1, 0.3, 0}, {0, 0, 4}});
  moving.add("rolls", ball(1, 0.1, grip_friction), {{0, 2, 0.1}, Quat::Identity()}, {{2, 0, 0}, {0, 0, 3}});
  moving.add("tumbles", block(1, {0.3, 0.2, 0.1}, grip_friction),
             {{0, 4, 0.4}, Quat(Eigen::AngleAxisd(0.5, Vec3::UnitX()))}, {{1, 0.5, 0}, {1, 5, 2}});
  moving.use(motion, 1000, moving.all_robots());
  moving.use_contacts();
  const double by_moving = out_of_cone(
      moving, [&] { moving.build(), moving.run_for(2); }, 0.01 * g);
  Grip grip(motion, 1.8, 0.004);
  const double by_grip = out_of_cone(
      grip, [&] { grip.begin(), grip.run_for(1); }, 0.01 * grip_effort);
  return {std::max(by_moving, by_grip), text(by_moving) + " moving, " + text(by_grip) + " held"};
}

}  // namespace

std::vector<Case> grip_cases() {
  constexpr Features needs = feature_contact | feature_friction | feature_joints;
  return {{"a finger goes no deeper into a wall that it presses", "m", needs | feature_fixed_base, 2.05e-4, press},
          {"two fingers hold what their friction can carry", "of 0.1 mm, 0.01 rad", needs, 1, holds_part},
          {"two fingers drop what is too heavy for their friction", "holds wrongly", needs, 0, drops_part},
          {"no contact leaves the cone of its friction", "relative", needs, 0.01, stays_in_cones}};
}

}  // namespace muro::conformance
