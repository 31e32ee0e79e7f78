// SPDX-License-Identifier: MIT
// Bodies that carry others: a body sinks no deeper into another body than into the ground, whatever it weighs.
#include <cmath>

#include "tests/conformance/motion/case.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {

namespace {

constexpr double of_loads = 0.8;  // friction of loads

/// Stacked boxes, the lowest on the ground.
struct Stack : Trial {
  struct Layer {
    double mass;
    Vec3 size;
  };
  std::vector<const RobotView*> boxes;
  std::vector<Layer> layers;

  Stack(const std::string& motion, std::vector<Layer> from_below, double rate) : Trial(motion, rate) {
    layers = std::move(from_below);
    add_ground(of_loads);
    double height = 0;
    for (const Layer& l : layers) {
      const std::string name = "box_" + std::to_string(boxes.size());
      boxes.push_back(
          &add(name, block(l.mass, l.size, of_loads), {{0, 0, height + 0.5 * l.size.z()}, Quat::Identity()}));
      height += l.size.z();
    }
    start();
  }
  /// Returns the greatest depth of a box in the one below it, m.
  double sunk() {
    double deepest = 0, top = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const double middle = pose(*boxes[i]).position.z(), half = 0.5 * layers[i].size.z();
      deepest = std::max(deepest, std::abs(middle - half - top));
      top = middle + half;
    }
    return deepest;
  }
};

/// Returns the greatest depth in several stacks at two rates after 2 s, m.
Outcome deepest(const std::string& motion, const std::vector<std::vector<Stack::Layer>>& stacks) {
  Outcome worst;
  for (const double rate : {1000.0, 250.0})
    for (const auto& layers : stacks) {
      Stack s(motion, layers, rate);
      s.run_for(2);
      const double sunk = s.sunk();
      if (!(sunk <= worst.error))
        worst = {sunk, text(sunk) + " m with " + text(layers.back().mass) + " kg on " + text(layers.front().mass) +
                           " kg at " + text(rate) + " Hz"};
    }
  return worst;
}

Outcome heavy_on_light(const std::string& motion) {
  const Vec3 board(0.8, 0.6, 0.02), load(0.3, 0.3, 0.2);
  return deepest(
      motion,
      {{{1, board}, {1, load}}, {{1, board}, {10, load}}, {{0.1, board}, {10, load}}, {{0.1, board}, {100, load}}});
}
Outcome light_on_heavy(const std::string& motion) {
  const Vec3 low(0.4, 0.4, 0.2), high(0.1, 0.1, 0.1);
  return deepest(motion, {{{10, low}, {1, high}}, {{100, low}, {1, high}}, {{100, low}, {0.1, high}}});
}
Outcome alone(const std::string& motion) {
  const Vec3 brick(0.2, 0.1, 0.06);
  return deepest(motion, {{{0.1, brick}}, {{1, brick}}, {{100, brick}}});
}
Outcome ten_boxes(const std::string& motion) {
  return deepest(motion, {std::vector<Stack::Layer>(10, {1, {0.2, 0.2, 0.2}})});
}

/// Returns how much lower than on the ground a rover is on a plank of 0.5 kg that lies on two bricks, m.
Outcome rover_on_a_plank(const std::string& motion) {
  Outcome worst;
  for (const double rate : {1000.0, 250.0}) {
    Trial t(motion, rate);
    t.add_ground(of_loads);
    const Vec3 brick(0.1, 0.4, 0.06), plank(0.8, 0.5, 0.02);
    for (const double x : {-0.3, 0.3})
      t.add(x < 0 ? "left" : "right", block(1, brick, of_loads), {{x, 0, 0.03}, Quat::Identity()});
    const RobotView& board = t.add("plank", block(0.5, plank, of_loads), {{0, 0, 0.07}, Quat::Identity()});
    const double m = 0.3, r = 0.06, l = 0.04, across = m * (3 * r * r + l * l) / 12;
    const RobotView& rover =
        t.add("rover",
              test::rover({.wheel = test::tyre(r, l),
                           .wheel_inertia = {.mass = m, .ixx = across, .iyy = m * r * r / 2, .izz = across}},
                          of_loads),
              {{0, 0, 0.09 + 0.08}, Quat::Identity()});
    t.start();
    t.run_for(2);
    const double sunk = 0.08 - t.pose(board).position.z() - 0.01,
                 wheels = t.pose(board).position.z() + 0.01 + 0.09 - t.pose(rover).position.z();
    const double most = std::max(std::abs(sunk) / 2, std::abs(wheels));
    if (most > worst.error)
      worst = {most, "plank " + text(sunk) + ", rover " + text(wheels) + " m too low at " + text(rate) + " Hz"};
  }
  return worst;
}

/// A trunk of 10 kg on four legs with light shanks. Servos hold hips and knees bent.
struct Quadruped : Trial {
  static constexpr double thigh = 0.2, lean = 0.6, foot = 0.02;  // m, rad, m
  static constexpr const char* legs[] = {"front_left", "front_right", "rear_left", "rear_right"};
  const RobotView* robot = nullptr;

  Quadruped(const std::string& motion, double rate) : Trial(motion, rate) {
    add_ground(of_loads);
    const RobotTree tree = test::tree_of([](RobotBuilder& b) {
      b.base("trunk");
      b.set(keys::inertial, solid_box(10, {0.4, 0.2, 0.1}));
      for (int k = 0; k < 4; ++k) {
        if (k < 3) b.fork();
        add_leg(b, legs[k], {k < 2 ? 0.2 : -0.2, k % 2 == 0 ? 0.1 : -0.1, 0});
        if (k < 3) b.end();
      }
      for (int k = 0; k < 3; ++k) b.end();
    });
    robot = &add("dog", tree, {{0, 0, 2 * thigh * std::cos(lean) + foot}, Quat::Identity()});
    start({{"joints", "position"}, {"effort_limits", true}});
  }
  /// Returns the depth of the foot that is deepest in the ground, m.
  double sunk() {
    double deepest = 0;
    for (const char* leg : legs) {
      const Pose& shank = world().value("dog/" + std::string(leg) + "_shank", keys::pose);
      deepest = std::max(deepest, foot - (shank * Vec3(0, 0, -thigh)).z());
    }
    return deepest;
  }

 private:
  static void add_leg(RobotBuilder& b, const std::string& name, const Vec3& hip) {
    const auto turned = [](double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitY())); };
    const auto rod = [](double mass) {
      const double across = mass * thigh * thigh / 12;
      return Inertia{.mass = mass, .com = {0, 0, -thigh / 2}, .ixx = across, .iyy = across, .izz = 1e-4 * mass};
    };
    b.translation(hip);
    b.rotation(turned(lean));
    b.revolute(name + "_hip", Vec3::UnitY(), {.effort = 60});
    b.body(name + "_thigh");
    b.set(keys::inertial, rod(0.6));
    b.translation({0, 0, -thigh});
    b.rotation(turned(-2 * lean));
    b.revolute(name + "_knee", Vec3::UnitY(), {.effort = 60});
    b.body(name + "_shank");
    b.set(keys::inertial, rod(0.15));
    Shape sphere = with(Shape::sphere(foot), of_loads);
    sphere.origin.position = {0, 0, -thigh};
    b.set_array(keys::collision_shapes, std::span<const Shape>(&sphere, 1));
  }
};

/// Returns the greatest depth of a foot during a second at rest, m.
Outcome on_four_legs(const std::string& motion) {
  Outcome worst;
  for (const double rate : {1000.0, 250.0}) {
    Quadruped dog(motion, rate);
    dog.run_for(4);
    for (int k = 0; k < 50; ++k) {
      dog.run_for(0.02);
      const double sunk = dog.sunk(), height = dog.pose(*dog.robot).position.z();
      if (!(height > 0.2)) return {1, "it has fallen"};
      if (sunk > worst.error) worst = {sunk, text(sunk) + " m at " + text(rate) + " Hz"};
    }
  }
  return worst;
}

}  // namespace

std::vector<Case> load_cases() {
  constexpr Features needs = feature_contact | feature_friction;
  constexpr double most = 2.05e-4;  // m
  return {
      {"a load sinks no deeper into a board of a thousandth", "m", needs, most, heavy_on_light},
      {"a box sinks no deeper into the ground", "m", needs, most, alone},
      {"a light box sinks no deeper into a heavy one", "m", needs, most, light_on_heavy},
      {"none of ten boxes in a stack sinks into another", "m", needs, most, ten_boxes},
      {"a rover stands on a plank on two bricks", "m", needs, most, rover_on_a_plank},
      {"feet sink no deeper under a robot that stands on four legs", "m", needs | feature_position_targets, most,
       on_four_legs},
  };
}

}  // namespace muro::conformance
