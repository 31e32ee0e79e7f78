// SPDX-License-Identifier: MIT
// Vehicles on wheels.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/motion/case.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {

namespace {

constexpr double wheel_radius = 0.06;

/// Returns a rover whose wheels are balls, so that every engine knows where they touch.
RobotTree rover(double friction, double com_height = 0) {
  return test::rover({.chassis = {0.35, 0.2, 0.1},
                      .com_height = com_height,
                      .wheel = Shape::sphere(wheel_radius),
                      .wheel_inertia = test::round_body(0.3, wheel_radius)},
                     friction);
}

struct Vehicle : Trial {
  const RobotView* robot;
  Vehicle(const std::string& motion, double friction, double slope = 0, double com_height = 0) : Trial(motion) {
    add_slope(slope, friction);
    const Quat tilt = from_rpy(0, -slope, 0);
    robot = &add("r", rover(friction, com_height), {tilt * Vec3(0, 0, 0.09), tilt});
    start();
  }
  void wheels(double left, double right) {
    for (const char* name : {"r/front_left_joint", "r/rear_left_joint"})
      joint(name, keys::joint_velocity_target) = left;
    for (const char* name : {"r/front_right_joint", "r/rear_right_joint"})
      joint(name, keys::joint_velocity_target) = right;
  }
};

Outcome drives(const std::string& motion) {
  Vehicle v(motion, 0.8);
  v.wheels(10, 10);
  v.run_for(1);
  const Vec3 before = v.pose(*v.robot).position;
  v.run_for(2);
  return relative((v.pose(*v.robot).position - before).x() / 2, 10 * wheel_radius);
}

Outcome parks(const std::string& motion) {
  Vehicle v(motion, 0.8, 30 * M_PI / 180);  // tan 30 deg = 0.577
  v.run_for(1);
  const Vec3 before = v.pose(*v.robot).position;
  v.run_for(2);
  const double creep = (v.pose(*v.robot).position - before).norm() / 2;
  return {creep, text(creep) + " m/s"};
}

Outcome slides(const std::string& motion) {
  const double slope = 30 * M_PI / 180;
  Vehicle v(motion, 0.4, slope);
  v.run_for(0.5);
  const double before = v.twist(*v.robot).linear.norm();
  v.run_for(1);
  return relative(v.twist(*v.robot).linear.norm() - before, g * (std::sin(slope) - 0.4 * std::cos(slope)));
}

Outcome climbs(const std::string& motion) {
  const double slope = 20 * M_PI / 180;
  Vehicle v(motion, 0.9, slope);
  v.wheels(5, 5);
  v.run_for(1);
  const Vec3 before = v.pose(*v.robot).position;
  v.run_for(2);
  return relative((v.pose(*v.robot).position - before).norm() / 2, 5 * wheel_radius);
}

/// Checks that four drives of torque e accelerate the vehicle, its wheels and their rotors:
/// a = (4 e / r) / (m + 4 (I + armature) / r^2).
Outcome speeds_up_rotors(const std::string& motion) {
  constexpr double torque = 0.05, armature = 0.01, kilograms = 5.2;
  Trial t(motion);
  t.add_ground(0.8);
  RobotTree tree = rover(0.8);
  for (std::size_t i = 0; i < tree.links().size(); ++i)
    if (tree.links()[i].joint >= 0) tree.set_limits(i, {.armature = armature});
  const RobotView& r = t.add("r", tree, {{0, 0, 0.09}, Quat::Identity()});
  t.start({{"joints", "effort"}});
  for (const char* name : {"front_left", "rear_left", "front_right", "rear_right"})
    t.joint(std::string("r/") + name + "_joint", keys::joint_effort_target) = torque;
  t.run_for(0.5);
  const double before = t.twist(r).linear.x();
  t.run_for(2);
  const double wheel = test::round_body(0.3, wheel_radius).iyy;
  return relative((t.twist(r).linear.x() - before) / 2,
                  4 * torque / wheel_radius / (kilograms + 4 * (wheel + armature) / (wheel_radius * wheel_radius)));
}

/// Checks the way with locked wheels: v^2 / (2 mu g).
Outcome brakes(const std::string& motion) {
  Vehicle v(motion, 0.5);
  v.wheels(25, 25);
  v.run_for(3);
  const double speed = v.twist(*v.robot).linear.x(), start = v.pose(*v.robot).position.x();
  v.wheels(0, 0);
  v.run_for(3);
  return relative(v.pose(*v.robot).position.x() - start, speed * speed / (2 * 0.5 * g));
}

/// Checks a centre of mass h above the ground and b before the rear axle: stays below tan = b / h and falls above.
Outcome tips(const std::string& motion) {
  const double com = 0.5, mass_of_wheels = 1.2;
  const double h = (4 * (0.09 + com) + mass_of_wheels * 0.06) / 5.2, limit = std::atan(0.12 / h);
  const auto falls = [&](double slope) {
    Vehicle v(motion, 1.5, slope, com);
    v.run_for(3);
    return (v.pose(*v.robot).orientation * Vec3::UnitZ()).dot(from_rpy(0, -slope, 0) * Vec3::UnitZ()) < 0.9;
  };
  const bool below = falls(limit - 0.02), above = falls(limit + 0.02);
  return {below || !above ? 1.0 : 0.0,
          std::string(below ? "falls" : "stays") + " 1 deg below, " + (above ? "falls" : "stays") + " 1 deg above"};
}

/// Checks the loads on a slope, nose up: the axles a and b before and behind the centre of mass carry m g (b cos -+ h
/// sin) / (a + b). They are means, since contact points change.
Outcome loads(const std::string& motion) {
  const double slope = 15 * M_PI / 180, com = 0.1;
  Vehicle v(motion, 0.9, slope, com);
  v.run_for(2);
  const double h = (4 * (0.09 + com) + 1.2 * 0.06) / 5.2, weight = 5.2 * g;
  const Vec3 normal = from_rpy(0, -slope, 0) * Vec3::UnitZ();
  const auto load = [&](const char* left, const char* right) {
    double sum = 0;
    for (const char* wheel : {left, right})
      sum += v.world().value(std::string("r/") + wheel, keys::contact_wrench).force.dot(normal);
    return sum;
  };
  constexpr int steps = 500;
  double front = 0, rear = 0;
  for (int i = 0; i < steps; ++i) {
    v.run_for(0.001);
    front += load("front_left", "front_right") / steps;
    rear += load("rear_left", "rear_right") / steps;
  }
  const double wanted = weight * (0.12 * std::cos(slope) - h * std::sin(slope)) / 0.24;
  const double others = weight * (0.12 * std::cos(slope) + h * std::sin(slope)) / 0.24;
  return {std::max(std::abs(front - wanted), std::abs(rear - others)) / weight,
          text(front) + " N for " + text(wanted) + ", " + text(rear) + " N for " + text(others)};
}

/// Checks an arc: r = 0.05 m, track 0.3 m, 8 and 10 rad/s for 10 s.
Outcome arc(const std::string& motion) {
  Trial t(motion);
  const RobotView& r = t.add("r", test::two_wheeler(0.05, 0.3));
  t.start();
  t.joint("r/left_joint", keys::joint_velocity_target) = 8;
  t.joint("r/right_joint", keys::joint_velocity_target) = 10;
  t.run_for(10);
  const Pose& p = t.pose(r);
  const double turn = std::remainder(yaw_of(p.orientation) - 3.3333333333, 2 * M_PI);
  return {std::max({std::abs(p.position.x() + 0.2572667), std::abs(p.position.y() - 2.6752599), std::abs(turn)}),
          text(p.position.x()) + ", " + text(p.position.y()) + ", " + text(yaw_of(p.orientation))};
}

}  // namespace

std::vector<Case> vehicle_cases() {
  constexpr Features needs = feature_contact | feature_friction | feature_velocity_targets;
  return {
      {"two wheels drive an exact arc", "m, rad", feature_velocity_targets, 1e-6, arc, "motion.differential_drive"},
      {"a rover drives as fast as its wheels turn", "relative", needs, 5e-3, drives},
      {"drives speed a rover up with its rotors", "relative",
       feature_contact | feature_friction | feature_effort_targets | feature_armature, 5e-3, speeds_up_rotors},
      {"a rover climbs 20 deg as fast as its wheels turn", "relative", needs, 1e-2, climbs},
      {"a rover parks on 30 deg when tan is below mu", "m/s", needs, 1e-4, parks},
      {"a rover with locked wheels slides down with g (sin - mu cos)", "relative", needs, 1e-2, slides},
      {"a rover brakes within v^2 / (2 mu g)", "relative", needs, 2e-2, brakes},
      {"axles on a slope carry m g (b cos -+ h sin) / (a + b)", "of the weight", needs | feature_link_dynamics, 0.01,
       loads},
      {"a rover tips where tan is b / h", "falls wrongly", needs, 0, tips},
  };
}

}  // namespace muro::conformance
