// SPDX-License-Identifier: MIT
// Wheeled vehicles for tests.
#pragma once

#include "tests/support/scene.hpp"

namespace muro::test {

/// A wheel with a joint "NAME_joint" and a body "NAME_wheel".
struct WheelPart {
  std::string name;
  Vec3 at = Vec3::Zero();  ///< m, of the joint in the frame of the base
  double radius = 0.05;    ///< m
  Vec3 axis = Vec3::UnitY();
  JointLimits limits{};
  Shape shape{};  ///< used when `own_shape`
  bool own_shape = false;
  bool visual = false;  ///< the shape is seen but does not collide
};

/// A cylinder whose axis is the y axis.
inline Shape tyre(double radius, double length = 0.04) {
  Shape s = Shape::cylinder(radius, length);
  s.origin.orientation = from_rpy(M_PI / 2, 0, 0);
  return s;
}

/// A base "chassis" that carries the wheels, and what `more` adds.
inline RobotTree wheeled_robot(
    const std::vector<WheelPart>& wheels, const std::function<void(RobotBuilder&)>& more = [](RobotBuilder&) {}) {
  return tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    for (const WheelPart& w : wheels) {
      const Shape shape = w.own_shape ? w.shape : tyre(w.radius);
      b.fork();
      b.translation(w.at);
      b.revolute(w.name + "_joint", w.axis, w.limits);
      b.body(w.name + "_wheel");
      b.set_array(w.visual ? keys::visual_shapes : keys::collision_shapes, std::span<const Shape>(&shape, 1));
      b.end();
    }
    more(b);
    for (std::size_t i = 0; i < wheels.size(); ++i) b.end();
  });
}

/// Two driven wheels, `track` apart, on the y axis of the base.
inline RobotTree two_wheeler(double radius, double track) {
  return wheeled_robot({{.name = "left", .at = {0, 0.5 * track, radius}, .radius = radius},
                        {.name = "right", .at = {0, -0.5 * track, radius}, .radius = radius}});
}

}  // namespace muro::test
