// SPDX-License-Identifier: MIT
// Limbs without drives: light bodies that hang on heavy ones.
#include <cmath>

#include "tests/conformance/motion/energies.hpp"

namespace muro::conformance {

namespace {

/// A trunk of 8 kg with two limp arms, whose hands have six fingers of 10 g each. It falls with its arms aside.
struct LimpRobot : Trial {
  static constexpr double fall = 0.5, friction = 0.8;  // m
  std::vector<std::pair<std::string, Inertia>> links;

  LimpRobot(const std::string& motion, const Quat& attitude) : Trial(motion) {
    add_ground(friction);
    const RobotTree tree = test::tree_of([this](RobotBuilder& b) {
      b.base("trunk");
      add_box(b, "trunk", 8, {0.3, 0.3, 0.2}, 0);
      for (const int side : {1, -1}) {
        if (side > 0) b.fork();
        add_arm(b, side > 0 ? "left" : "right", side);
        if (side > 0) b.end();
      }
      b.end();
    });
    add("r", tree, {{0, 0, 0.3 + fall}, attitude});
    start({{"joints", "passive"}});
  }
  double energy() {
    double sum = 0;
    for (const auto& [name, inertia] : links)
      sum += energy_of(inertia, world().value("r/" + name, keys::pose), world().value("r/" + name, keys::twist));
    return sum;
  }
  /// Returns the speed of the fastest link, m/s.
  double fastest() {
    double speed = 0;
    for (const auto& [name, inertia] : links) {
      const Pose& pose = world().value("r/" + name, keys::pose);
      const Vec3 centre = pose * inertia.com;
      speed = std::max(speed, world().value("r/" + name, keys::twist).at(centre - pose.position).norm());
    }
    return speed;
  }

 private:
  /// Gives the last body a box that extends from its origin along y, or is centred on it (`side` 0).
  void add_box(RobotBuilder& b, const std::string& name, double mass, const Vec3& size, int side) {
    Inertia inertia = solid_box(mass, size);
    Shape shape = with(Shape::box(size), friction);
    inertia.com = shape.origin.position = Vec3(0, 0.5 * side * size.y(), 0);
    b.set(keys::inertial, inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
    links.emplace_back(name, inertia);
  }
  void add_joint(RobotBuilder& b, const std::string& name, const Vec3& axis, double most) {
    b.revolute(name + "_joint", axis, {.lower = -most, .upper = most, .damping = 1e-4});
    b.body(name);
  }
  void add_arm(RobotBuilder& b, const std::string& arm, int side) {
    b.translation({0, side * 0.16, 0.05});
    add_joint(b, arm + "_upper", Vec3::UnitX(), 1.2);
    add_box(b, arm + "_upper", 0.6, {0.06, 0.25, 0.06}, side);
    b.translation({0, side * 0.26, 0});
    add_joint(b, arm + "_lower", Vec3::UnitX(), 1.5);
    add_box(b, arm + "_lower", 0.4, {0.05, 0.22, 0.05}, side);
    b.translation({0, side * 0.23, 0});
    add_joint(b, arm + "_palm", Vec3::UnitX(), 0.8);
    add_box(b, arm + "_palm", 0.15, {0.1, 0.08, 0.03}, side);
    for (int finger = 0; finger < 6; ++finger) {
      if (finger < 5) b.fork();
      b.translation({-0.045 + 0.018 * finger, side * 0.081, 0});
      const std::string name = arm + "_finger_" + std::to_string(finger);
      add_joint(b, name, Vec3::UnitX(), 0.9);
      add_box(b, name, 0.01, {0.012, 0.06, 0.012}, side);
      if (finger < 5) b.end();
    }
    for (int finger = 0; finger < 5; ++finger) b.end();
  }
};

struct Fall {
  double gain = 0;     ///< largest gain of energy, as a fraction of that of the fall
  double fastest = 0;  ///< largest speed of a link, as a fraction of the speed of the fall
};
Fall fall_of(const std::string& motion, const Quat& attitude) {
  LimpRobot robot(motion, attitude);
  robot.run_for(0.001);  // by now links have their poses
  double mass = 0, least = robot.energy();
  for (const auto& [name, inertia] : robot.links) mass += inertia.mass;
  const double of_fall = mass * g * LimpRobot::fall, speed = std::sqrt(2 * g * LimpRobot::fall);
  Fall seen;
  for (int k = 0; k < 1500; ++k) {
    robot.run_for(0.001);
    seen.fastest = std::max(seen.fastest, robot.fastest() / speed);
    if (k % 10 != 0) continue;
    const double now = robot.energy();
    seen.gain = std::max(seen.gain, (now - least) / of_fall);
    least = std::min(least, now);
  }
  return seen;
}

/// Checks falls on the back, a hand and the head, and turned over. No link gets much faster than what hits the ground.
Outcome falls(const std::string& motion) {
  constexpr double whip = 4;
  Fall worst;
  for (const Vec3& turn : {Vec3(0.2, 0.1, 0), Vec3(1.2, 0, 0.3), Vec3(0.4, 1.4, 0), Vec3(2.9, 0.2, 0)}) {
    const Fall seen = fall_of(motion, Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized())));
    worst = {std::max(worst.gain, seen.gain), std::max(worst.fastest, seen.fastest)};
  }
  return {worst.fastest < whip ? worst.gain : 1,
          text(worst.gain) + " of the fall gained, " + text(worst.fastest) + " times as fast"};
}

}  // namespace

std::vector<Case> limb_cases() {
  constexpr Features needs = feature_contact | feature_friction | feature_joints | feature_link_dynamics;
  return {{"a limp robot with twelve light fingers falls and throws nothing", "of the energy", needs, 0.02, falls}};
}

}  // namespace muro::conformance
