// SPDX-License-Identifier: MIT
// Bodies and scenes of the tests of contact.penalty: the real chain of index, collision, contact and motion.
#pragma once

#include "tests/support/scene.hpp"

namespace muro::test {

inline constexpr double g = 9.81;

inline Inertia solid_box(double mass, const Vec3& s) {
  const Vec3 q = s.cwiseAbs2() * (mass / 12);
  return {.mass = mass, .ixx = q.y() + q.z(), .iyy = q.x() + q.z(), .izz = q.x() + q.y()};
}
/// `factor` m r^2 about every axis: 2/5 for a solid sphere.
inline Inertia round_body(double mass, double radius, double factor = 0.4) {
  const double i = factor * mass * radius * radius;
  return {.mass = mass, .ixx = i, .iyy = i, .izz = i};
}
inline Shape with(Shape shape, double friction, double restitution = 0) {
  shape.friction = friction;
  shape.restitution = restitution;
  return shape;
}
inline RobotTree block(double mass, const Vec3& size, double friction, double restitution = 0) {
  return single_body(with(Shape::box(size), friction, restitution), solid_box(mass, size));
}
inline RobotTree ball(double mass, double radius, double friction, double restitution = 0, double factor = 0.4) {
  return single_body(with(Shape::sphere(radius), friction, restitution), round_body(mass, radius, factor));
}

/// Four wheels of radius 0.06 m at x = +-0.12, y = +-0.15 m; stands on z = 0 with its base at 0.09 m; 5.2 kg.
/// `com_height`: of the chassis (4 kg), over its middle.
inline RobotTree rover(double friction, double com_height = 0) {
  return tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    const Vec3 size(0.35, 0.25, 0.12);
    Inertia inertia = solid_box(4, size);
    inertia.com.z() = com_height;
    b.set(keys::inertial, inertia);
    const Shape chassis = with(Shape::box(size), friction);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&chassis, 1));
    const char* const names[] = {"front_left", "front_right", "rear_left", "rear_right"};
    for (int k = 0; k < 4; ++k) {
      if (k < 3) b.fork();
      b.translation({k < 2 ? 0.12 : -0.12, k % 2 == 0 ? 0.15 : -0.15, -0.03});
      b.revolute(std::string(names[k]) + "_joint", Vec3::UnitY(), {});
      b.body(names[k]);
      const double m = 0.3, r = 0.06, l = 0.04;
      b.set(keys::inertial, Inertia{.mass = m,
                                    .ixx = m * (3 * r * r + l * l) / 12,
                                    .iyy = m * r * r / 2,
                                    .izz = m * (3 * r * r + l * l) / 12});
      Shape wheel = with(Shape::cylinder(r, l), friction);
      wheel.origin.orientation = from_rpy(M_PI / 2, 0, 0);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&wheel, 1));
      if (k < 3) b.end();
    }
    for (int k = 0; k < 3; ++k) b.end();
  });
}

struct ContactScene : Scene {
  /// Connects and starts. All robots move by motion.simplified.
  void start(double rate = 1000, double frequency = 50) {
    use("motion.simplified", rate, all_robots());
    use_contacts({{"frequency", frequency}});
    build();
  }
  /// A wall or table: an axis-aligned box.
  void add_box(std::string_view name, const Vec3& centre, const Vec3& size, double friction) {
    const Shape box = with(Shape::box(size), friction);
    world().add_scenery(name, {centre, Quat::Identity()}, std::span<const Shape>(&box, 1));
  }
  /// Wheel speeds of a rover, rad/s.
  void wheels(const std::string& robot, double left, double right) {
    for (const char* joint : {"/front_left_joint", "/rear_left_joint"})
      world().value(robot + joint, keys::joint_velocity_target) = left;
    for (const char* joint : {"/front_right_joint", "/rear_right_joint"})
      world().value(robot + joint, keys::joint_velocity_target) = right;
  }
  /// A wrench on a robot that the test sets. Before start().
  Wrench& push(const RobotView& robot) {
    PropertyStore& store = world().store();
    return *static_cast<Wrench*>(store.bind(store.add_party("the test"), robot.base(), keys::external_wrench,
                                            Access::accumulate, Form::single, 1, nullptr));
  }
  /// What acts on a robot, summed.
  Wrench external(const RobotView& robot) {
    return SumIn<Wrench>(world().store().find(robot.base(), "wrench.external")->sum).value();
  }
  std::span<Contact> contacts(const RobotView& robot) { return world().values(robot.base(), keys::contacts); }
};

}  // namespace muro::test
