// SPDX-License-Identifier: MIT
#include "host/scenario/body.hpp"

#include "muro/vocabulary.hpp"

namespace muro::host {

Inertia solid(const Shape& s, double mass) {
  const double r = s.size.x(), l = s.size.z();
  Inertia i{.mass = mass};
  const auto axial = [&](double across, double along) { i.ixx = i.iyy = across, i.izz = along; };
  switch (s.kind) {
    case ShapeKind::box: {
      const Vec3 q = s.size.cwiseProduct(s.size) * (mass / 12);
      i.ixx = q.y() + q.z(), i.iyy = q.x() + q.z(), i.izz = q.x() + q.y();
      break;
    }
    case ShapeKind::cylinder:
      axial(mass * (3 * r * r + l * l) / 12, mass * r * r / 2);
      break;
    case ShapeKind::capsule: {
      const double tube = r * r * l, balls = 4.0 / 3 * r * r * r, mt = mass * tube / (tube + balls), mb = mass - mt;
      axial(mt * (3 * r * r + l * l) / 12 + mb * (0.4 * r * r + l * l / 4 + 3.0 / 8 * l * r),
            mt * r * r / 2 + mb * 0.4 * r * r);
      break;
    }
    default:
      axial(0.4 * mass * r * r, 0.4 * mass * r * r);
  }
  return i;
}

RobotTree single_body(const Shape& shape, double mass) {
  RobotTree tree;
  tree.base("body");
  tree.set(keys::inertial, solid(shape, mass));
  tree.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  tree.set_array(keys::visual_shapes, std::span<const Shape>(&shape, 1));
  tree.close();
  return tree;
}

}  // namespace muro::host
