// SPDX-License-Identifier: MIT
// Robots of one body.
#pragma once

#include "tests/support/scene.hpp"

namespace muro::test {

Shape with(Shape shape, double friction, double restitution = 0);

/// Returns a robot of one body with one shape.
RobotTree single_body(const Shape& shape, const Inertia& inertia);

Inertia solid_box(double mass, const Vec3& size);
/// The axis of the cylinder is z.
Inertia solid_cylinder(double mass, double radius, double length);
/// Inertia of `factor` m r^2 about every axis: 2/5 for a solid sphere.
Inertia round_body(double mass, double radius, double factor = 0.4);

RobotTree block(double mass, const Vec3& size, double friction, double restitution = 0);
RobotTree ball(double mass, double radius, double friction, double restitution = 0, double factor = 0.4);

}  // namespace muro::test
