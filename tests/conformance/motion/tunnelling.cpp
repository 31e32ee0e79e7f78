// SPDX-License-Identifier: MIT
// Speeds from which a ball passes through an obstacle that should stop it.
#include "tests/conformance/motion/tunnelling.hpp"

#include <algorithm>
#include <cmath>

#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

constexpr double dt = 1e-3, radius = 0.05;  // s, m
constexpr int phases = 8;

/// Whether a ball that flies against a wall (`thickness` 0: a plane) at `speed` continues behind it. `phase`: distance
/// from the wall at the beginning of a step, as a fraction of a step.
bool passes(const std::string& motion, double thickness, double speed, double phase) {
  Trial m(motion, 1 / dt);
  m.set_gravity(Vec3::Zero());
  if (thickness > 0) {
    const Shape wall = with(Shape::box({2, 2, thickness}), 0.5);
    m.world().add_scenery("wall", {{0, 0, -0.5 * thickness}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
  } else {
    m.add_ground(0.5);
  }
  const double height = radius + (3 + phase) * speed * dt;
  const RobotView& r =
      m.add("ball", ball(1, radius, 0.5), {{0, 0, height}, Quat::Identity()}, {{0, 0, -speed}, Vec3::Zero()});
  m.start({{"watch", std::string("off")}, {"on_contact", std::string("stop")}});
  if ((description_of(motion).features & feature_forces) == 0)
    m.world().value(r.base(), keys::command_twist).linear.z() = -speed;
  m.run_for(20 * dt);
  return m.twist(r).linear.z() < -0.5 * speed;
}

Outcome is_stopped(const std::string& motion) {
  constexpr double thickness = 0.1;
  const double speed = 0.8 * (0.5 * thickness + radius) / dt;
  int passed = 0;
  for (int k = 0; k < phases; ++k) passed += passes(motion, thickness, speed, double(k) / phases) ? 1 : 0;
  return {double(passed), text(passed) + " of " + text(phases) + " pass at " + text(speed) + " m/s"};
}

}  // namespace

double tunnelling_speed(const std::string& motion, double thickness) {
  const auto some_pass = [&](double speed) {
    for (int k = 0; k < phases; ++k)
      if (passes(motion, thickness, speed, double(k) / phases)) return true;
    return false;
  };
  double low = 1, high = 1e4;
  if (!some_pass(high)) return std::numeric_limits<double>::infinity();
  while (high / low > 1.03) {
    const double middle = std::sqrt(low * high);
    (some_pass(middle) ? high : low) = middle;
  }
  return low;
}

std::vector<Case> tunnelling_cases() {
  return {{"a wall stops a ball that moves less than half of both in a step", "passed",
           feature_contact | feature_forces, 0, is_stopped}};
}

}  // namespace muro::conformance
