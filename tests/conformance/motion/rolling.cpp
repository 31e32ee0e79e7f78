// SPDX-License-Identifier: MIT
// Bodies that roll.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

constexpr double slope = 20 * M_PI / 180;

/// Returns the acceleration of a round body down the slope.
double rolls(const std::string& motion, const RobotTree& tree, double radius, const Quat& turn) {
  Trial t(motion);
  t.add_slope(slope, 0.5);
  const Quat tilt = from_rpy(0, -slope, 0);
  const RobotView& r = t.add("round", tree, {tilt * Vec3(0, 0, radius), tilt * turn});
  t.start();
  const auto speed = [&] { return -t.twist(r).linear.dot(tilt * Vec3::UnitX()); };
  t.run_for(0.5);
  const double before = speed();
  t.run_for(1);
  return speed() - before;
}

Outcome sphere(const std::string& motion) {
  return relative(rolls(motion, ball(1, 0.1, 0.5), 0.1, Quat::Identity()), 5.0 / 7 * g * std::sin(slope));
}
Outcome hollow(const std::string& motion) {
  return relative(rolls(motion, ball(1, 0.1, 0.5, 0, 2.0 / 3), 0.1, Quat::Identity()), 0.6 * g * std::sin(slope));
}
Outcome cylinder(const std::string& motion) {
  const double r = 0.1, l = 0.3;
  const RobotTree tree = test::single_body(with(Shape::cylinder(r, l), 0.5), solid_cylinder(1, r, l));
  return relative(rolls(motion, tree, r, from_rpy(M_PI / 2, 0, 0)), 2.0 / 3 * g * std::sin(slope));
}

constexpr double ball_radius = 0.1, lever = 0.004;  // m

/// A ball of 1 kg on grass: a resistance of the ground to rolling, or of the ball to spinning.
struct Grass : Trial {
  const RobotView* ball_;

  Grass(const std::string& motion, const Surface& of_ground, const Surface& of_ball, const Twist& twist,
        double angle = 0)
      : Trial(motion) {
    const auto with_surface = [](Shape shape, const Surface& surface) {
      shape.surface = surface;
      return shape;
    };
    const Quat tilt = from_rpy(0, -angle, 0);
    const Shape ground = with_surface(Shape::plane(), of_ground);
    world().add_scenery("ground", {Vec3::Zero(), tilt}, std::span<const Shape>(&ground, 1));
    const double inertia = 0.4 * ball_radius * ball_radius;
    ball_ = &add("ball",
                 test::single_body(with_surface(Shape::sphere(ball_radius), of_ball),
                                   {.mass = 1, .ixx = inertia, .iyy = inertia, .izz = inertia}),
                 {tilt * Vec3(0, 0, ball_radius), tilt}, twist);
    start();
  }
};

/// Checks that the normal force acts before the contact by the coefficient b of rolling resistance: a ball that rolls
/// is slowed by g b / (1.4 r), and stops after 0.7 r v^2 / (g b).
Outcome rolls_out(const std::string& motion) {
  const double speed = 1;
  Grass t(motion, {.friction = 0.8, .rolling_resistance = lever}, {}, {{speed, 0, 0}, {0, speed / ball_radius, 0}});
  t.run_for(5);
  const double way = t.pose(*t.ball_).position.x();
  if (t.twist(*t.ball_).linear.norm() > 1e-6) return {1, "it rolls on"};
  return relative(way, 0.7 * ball_radius * speed * speed / (g * lever));
}

/// Checks a ball at rest on a slope; tan of its angle is below b / r.
Outcome rests_on_a_slope(const std::string& motion) {
  Grass t(motion, {.friction = 0.8, .rolling_resistance = lever}, {}, {}, std::atan(0.9 * lever / ball_radius));
  t.run_for(1);
  const Vec3 before = t.pose(*t.ball_).position;
  t.run_for(2);
  const double creep = (t.pose(*t.ball_).position - before).norm() / 2;
  return {creep, text(creep) + " m/s"};
}

/// Checks that the larger one of two coefficients counts.
Outcome spins_out(const std::string& motion) {
  const double rate = 20, slowed = g * lever / (0.4 * ball_radius * ball_radius);
  Grass t(motion, {.spinning_resistance = 0.5 * lever}, {.spinning_resistance = lever}, {Vec3::Zero(), {0, 0, rate}});
  t.run_for(0.5 * rate / slowed);
  const double halfway = t.twist(*t.ball_).angular.z();
  t.run_for(0.6 * rate / slowed);
  if (const double rest = std::abs(t.twist(*t.ball_).angular.z()); rest > 1e-6)
    return {1, "it spins on with " + text(rest)};
  return relative(halfway, 0.5 * rate);
}

/// Checks that a ball that slides at 5 m/s with mu = 0.2 ends rolling at 5/7 of that speed.
Outcome sliding_ball(const std::string& motion) {
  Trial t(motion);
  t.add_ground(0.2);
  const RobotView& r = t.add("ball", ball(1, 0.1, 0.2), {{0, 0, 0.1}, Quat::Identity()}, {{5, 0, 0}, Vec3::Zero()});
  t.start();
  t.run_for(1.5);
  return relative(t.twist(r).linear.x(), 3.5714286);
}

/// Checks the acceleration of 25 balls on a box that is pushed (SimBenchmark, rolling).
Outcome stack(const std::string& motion, double angle) {
  Trial t(motion);
  t.add_ground(0.4);
  const RobotView& box = t.add("box", block(10, {20, 20, 1}, 0.4), {{0, 0, 0.5}, Quat::Identity()});
  std::vector<const RobotView*> balls;
  for (const int row : {-2, -1, 0, 1, 2})
    for (const int column : {-2, -1, 0, 1, 2})
      balls.push_back(&t.add("ball_" + std::to_string(balls.size()), ball(1, 0.5, 1.6),
                             {{3.0 * column, 3.0 * row, 1.5}, Quat::Identity()}));
  Wrench& push = t.push(box);
  t.start();
  t.run_for(0.5);
  push = {150 * Vec3(std::cos(angle), std::sin(angle), 0), Vec3::Zero()};
  const auto speed = [&] {
    Vec3 sum = Vec3::Zero();
    for (const RobotView* b : balls) sum += t.twist(*b).linear;
    return sum.dot(Vec3(std::cos(angle), std::sin(angle), 0)) / 25;
  };
  t.run_for(0.5);
  const double before = speed();
  t.run_for(1);
  return relative(speed() - before, 0.211);
}
Outcome stack_along(const std::string& motion) { return stack(motion, M_PI / 2); }
Outcome stack_across(const std::string& motion) { return stack(motion, M_PI / 3); }

}  // namespace

std::vector<Case> rolling_cases() {
  constexpr Features needs = feature_contact | feature_friction;
  return {
      {"a solid sphere rolls down 20 deg with 5/7 g sin", "relative", needs, 2e-3, sphere},
      {"a hollow sphere rolls down with 3/5 g sin", "relative", needs, 2e-3, hollow},
      {"a cylinder rolls down with 2/3 g sin", "relative", needs, 2e-3, cylinder},
      {"a ball that slides comes to roll at 5/7 of its speed", "relative", needs, 2e-3, sliding_ball},
      {"a ball on grass stops after 0.7 r v^2 / (g b)", "relative", needs | feature_rolling_resistance, 0.01,
       rolls_out},
      {"a ball rests on a slope that its rolling resistance holds", "m/s", needs | feature_rolling_resistance, 1e-4,
       rests_on_a_slope},
      {"a spinning ball is slowed by spinning resistance", "relative", needs | feature_spinning_resistance, 0.01,
       spins_out},
      {"25 balls roll on a box that is pushed along an axis", "relative", needs, 0.02, stack_along},
      {"25 balls roll on a box that is pushed at 60 deg", "relative", needs, 0.02, stack_across},
  };
}

}  // namespace muro::conformance
