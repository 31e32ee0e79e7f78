// SPDX-License-Identifier: MIT
// Feet and bumpers.
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {

namespace {

/// A robot of 3.5 kg whose centre of mass is (0.02, 0.01) off the middle of its foot.
struct Stander : Trial {
  ObjectId foot{};
  explicit Stander(const std::string& motion, Parameters parameters = {}) : Trial(motion) {
    add_ground();
    const Shape sole = test::with(Shape::box({0.3, 0.2, 0.04}), 0.8);
    const bool is_driven = family() == Family::wheeled || family() == Family::legged;
    if (is_driven)
      add_vehicle();
    else
      add("r", test::tree_of([&](RobotBuilder& b) {
            b.base("trunk");
            b.set(keys::inertial, Inertia{.mass = 3.5, .com = {0.02, 0.01, 0}, .ixx = 0.03, .iyy = 0.03, .izz = 0.03});
            b.translation({0, 0, -0.2});
            b.body("foot");
            b.set_array(keys::collision_shapes, std::span<const Shape>(&sole, 1));
          }),
          {{0, 0, 0.22}, Quat::Identity()});
    foot = add_sensor("sensor.foot", is_driven ? "base_link" : "foot", std::move(parameters));
    start();
    run_for(1.0005);
  }
};

Outcome weight(const std::string& motion) {
  Stander t(motion);
  return difference(t.world().value(t.foot, keys::foot_force) / (3.5 * g), 1);
}

Outcome center_of_pressure(const std::string& motion) {
  Stander t(motion);
  return difference(t.world().value(t.foot, keys::foot_center_of_pressure), {0.02, 0.01, -0.02});
}

/// Checks the contact at a weight of 34.3 N: not with a threshold above it, but with one below it.
Outcome threshold(const std::string& motion) {
  Stander below(motion, {{"threshold", 30.0}}), above(motion, {{"threshold", 40.0}, {"release_threshold", 36.0}});
  return difference(double(below.world().value(below.foot, keys::foot_contact)) -
                        double(above.world().value(above.foot, keys::foot_contact)),
                    1);
}

/// Checks a bumper that drives against a wall: not pressed before, pressed then.
Outcome bumper(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  const Shape wall = test::with(Shape::box({0.2, 4, 2}), 0);
  t.world().add_scenery("wall", {{1, 0, 1}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
  const bool pushed = t.family() == Family::forces;
  if (pushed)
    t.add("r", test::block(2, {0.4, 0.3, 0.2}, 0.2), {{0, 0, 0.1}, Quat::Identity()});
  else
    t.add_vehicle({{0, 0, motion == "motion.point" ? 0.1 : 0.06}, Quat::Identity()});
  Wrench& push = t.push(t.robot());
  const std::string foremost = motion == "motion.differential_drive" ? "front_left_wheel" : t.base_name();
  const ObjectId s = t.add_sensor("sensor.bumper", foremost, {{"ignore_ground", true}});
  t.find_contacts();
  t.start({{"on_contact", "stop"}});
  push.force = {12, 0, 0};
  t.command(0.4, 0);
  t.run_for(0.1005);
  const double before = t.world().value(s, keys::bumper_pressed);
  t.run_for(3);
  return difference(double(t.world().value(s, keys::bumper_pressed)) - before, 1);
}

constexpr How a = How::analytic, no = How::refused;

}  // namespace

std::vector<Case> touch_cases() {
  return {
      {"a foot feels the weight of the robot", "sensor.foot", "relative", {no, no, a}, {0, 0, 0.01}, weight},
      {"the centre of pressure lies under the centre of mass",
       "sensor.foot",
       "m",
       {no, no, a},
       {0, 0, 1e-3},
       center_of_pressure},
      {"a foot is in contact from its threshold on", "sensor.foot", "1", {no, no, a}, {0, 0, 0}, threshold},
      {"a bumper is pressed at a wall, and not before", "sensor.bumper", "1", {a, a, a}, {0, 0, 0}, bumper},
  };
}

}  // namespace muro::sensor_conformance
