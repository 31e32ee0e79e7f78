// SPDX-License-Identifier: MIT
// Bodies that carry others: what rests on something sinks in by no more than what rests on the ground, whatever it
// weighs.
#include <cmath>

#include "tests/conformance/motion/case.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {

namespace {

constexpr double of_loads = 0.8;  // friction

/// Boxes on each other, the lowest on the ground.
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
  /// m: how deep the deepest box is in what is below it.
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

/// m: the deepest of several stacks at two rates, after 2 s.
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

/// m: how much lower than on the ground a rover stands on a plank of 0.5 kg that lies on two bricks.
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
  };
}

}  // namespace muro::conformance
