// SPDX-License-Identifier: MIT
#include "tests/support/wheeled_robot.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::test {

Shape tyre(double radius, double length) {
  Shape s = Shape::cylinder(radius, length);
  s.origin.orientation = from_rpy(M_PI / 2, 0, 0);
  return s;
}

RobotTree wheeled_robot(const std::vector<WheelPart>& wheels, const std::function<void(RobotBuilder&)>& more) {
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

RobotTree two_wheeler(double radius, double track) {
  return wheeled_robot({{.name = "left", .at = {0, 0.5 * track, radius}, .radius = radius},
                        {.name = "right", .at = {0, -0.5 * track, radius}, .radius = radius}});
}

RobotTree rover(const RoverBody& body, double friction) {
  return tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    Inertia inertia = solid_box(4, body.chassis);
    inertia.com.z() = body.com_height;
    b.set(keys::inertial, inertia);
    const Shape chassis = with(Shape::box(body.chassis), friction), wheel = with(body.wheel, friction);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&chassis, 1));
    const char* const names[] = {"front_left", "front_right", "rear_left", "rear_right"};
    for (int k = 0; k < 4; ++k) {
      if (k < 3) b.fork();
      b.translation({k < 2 ? 0.12 : -0.12, k % 2 == 0 ? 0.15 : -0.15, -0.03});
      b.revolute(std::string(names[k]) + "_joint", Vec3::UnitY(), {});
      b.body(names[k]);
      b.set(keys::inertial, body.wheel_inertia);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&wheel, 1));
      if (k < 3) b.end();
    }
    for (int k = 0; k < 3; ++k) b.end();
  });
}

}  // namespace muro::test
