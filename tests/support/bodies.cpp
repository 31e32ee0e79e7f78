// SPDX-License-Identifier: MIT
#include "tests/support/bodies.hpp"

namespace muro::test {

Shape with(Shape shape, double friction, double restitution) {
  shape.surface.friction = friction;
  shape.surface.restitution = restitution;
  return shape;
}

RobotTree single_body(const Shape& shape, const Inertia& inertia) {
  return tree_of([&](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  });
}

Inertia solid_box(double mass, const Vec3& size) {
  const Vec3 q = size.cwiseAbs2() * (mass / 12);
  return {.mass = mass, .ixx = q.y() + q.z(), .iyy = q.x() + q.z(), .izz = q.x() + q.y()};
}

Inertia solid_cylinder(double mass, double radius, double length) {
  const double across = mass * (3 * radius * radius + length * length) / 12;
  return {.mass = mass, .ixx = across, .iyy = across, .izz = mass * radius * radius / 2};
}

Inertia round_body(double mass, double radius, double factor) {
  const double i = factor * mass * radius * radius;
  return {.mass = mass, .ixx = i, .iyy = i, .izz = i};
}

RobotTree block(double mass, const Vec3& size, double friction, double restitution) {
  return single_body(with(Shape::box(size), friction, restitution), solid_box(mass, size));
}

RobotTree ball(double mass, double radius, double friction, double restitution, double factor) {
  return single_body(with(Shape::sphere(radius), friction, restitution), round_body(mass, radius, factor));
}

}  // namespace muro::test
