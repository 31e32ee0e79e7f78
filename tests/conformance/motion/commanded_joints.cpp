// SPDX-License-Identifier: MIT
// Joints that the scenario does not mention: those that algorithms command follow; the others turn freely.
#include "tests/conformance/motion/case.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {

namespace {

constexpr double tyre = 0.05, wheelbase = 0.33, half_track = 0.118;

/// Returns a car of scale 1:10 with balls as wheels. Rear wheels are driven, front wheels steered by separate joints.
RobotTree steered_car() {
  return test::tree_of([&](RobotBuilder& b) {
    const Shape ball = with(Shape::sphere(tyre), 0.8);
    const auto add_wheel = [&](const std::string& name) {
      b.revolute(name + "_wheel", Vec3::UnitY(), {.effort = 1, .damping = 2e-4, .friction = 1e-3});
      b.body(name + "_tyre");
      b.set(keys::inertial, test::round_body(0.15, tyre));
      b.set_array(keys::collision_shapes, std::span(&ball, 1));
    };
    b.base("base");
    b.set(keys::inertial, Inertia{.mass = 2.8, .com = {0.16, 0, 0.03}, .ixx = 0.006, .iyy = 0.05, .izz = 0.054});
    for (const double side : {1.0, -1.0}) {
      const std::string name = side > 0 ? "left" : "right";
      b.fork();
      b.translation({0, side * half_track, 0});
      add_wheel("rear_" + name);
      b.end();
      b.fork();
      b.translation({wheelbase, side * (half_track - 0.02), 0});
      b.revolute("front_" + name + "_steering", Vec3::UnitZ(), {-0.5, 0.5, 3.2, 2, 0.01, 0.01});
      b.body("front_" + name + "_knuckle");
      b.set(keys::inertial, Inertia{.mass = 0.05, .ixx = 1e-5, .iyy = 1e-5, .izz = 5e-6});
      b.translation({0, side * 0.02, 0});
      add_wheel("front_" + name);
      b.end();
    }
    for (int i = 0; i < 4; ++i) b.end();
  });
}

/// A car driven by an algorithm that knows nothing of the motion: 0.6 m/s, 0.3 rad/s.
struct Driven : Trial {
  const RobotView* robot;
  explicit Driven(const std::string& motion) : Trial(motion) {
    add_ground(0.8);
    robot = &add("r", steered_car(), {{0, 0, tyre}, Quat::Identity()});
    use("drive.ackermann", 1000, all_robots());
    start();
    world().value("r/base", keys::command_twist) = {{0.6, 0, 0}, {0, 0, 0.3}};
    run_for(2);
  }
};

Outcome follows_drive(const std::string& motion) {
  Driven car(motion);
  double speed = 0, turn = 0;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    car.run_for(0.001);
    const Pose& pose = car.pose(*car.robot);
    speed += (pose.orientation.conjugate() * car.twist(*car.robot).linear).x() / steps;
    turn += car.twist(*car.robot).angular.z() / steps;
  }
  const Outcome ahead = relative(speed, 0.6), around = relative(turn, 0.3);
  return {std::max(ahead.error, around.error), ahead.seen + " m/s, " + around.seen + " rad/s"};
}

/// Compares the speed of the front wheels, which have no drive, with that of their centres.
Outcome rolls_along(const std::string& motion) {
  Driven car(motion);
  const double left = car.joint("r/front_left_wheel", keys::joint_velocity),
               right = car.joint("r/front_right_wheel", keys::joint_velocity);
  const double inner = std::hypot(0.6 - 0.3 * half_track, 0.3 * wheelbase) / tyre,
               outer = std::hypot(0.6 + 0.3 * half_track, 0.3 * wheelbase) / tyre;
  const Outcome a = relative(left, inner), b = relative(right, outer);
  return {std::max(a.error, b.error), a.seen + " and " + b.seen + " rad/s"};
}

}  // namespace

std::vector<Case> commanded_joint_cases() {
  constexpr Features needs =
      feature_forces | feature_contact | feature_friction | feature_velocity_targets | feature_position_targets;
  return {
      {"a car follows its drive, with no word of its joints", "relative", needs, 0.02, follows_drive},
      {"wheels that nobody drives roll along", "relative", needs, 0.02, rolls_along},
  };
}

}  // namespace muro::conformance
