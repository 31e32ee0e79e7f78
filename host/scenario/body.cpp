// SPDX-License-Identifier: MIT
#include "host/scenario/body.hpp"

#include "muro/vocabulary.hpp"

namespace muro::host {

Inertia homogeneous_inertia(const Shape& s, double mass) {
  const double r = s.size.x(), l = s.size.z();
  Inertia i{.mass = mass};
  const auto set_axisymmetric = [&](double transverse, double axial) { i.ixx = i.iyy = transverse, i.izz = axial; };
  switch (s.kind) {
    case ShapeKind::box: {
      const Vec3 q = s.size.cwiseProduct(s.size) * (mass / 12);
      i.ixx = q.y() + q.z(), i.iyy = q.x() + q.z(), i.izz = q.x() + q.y();
      break;
    }
    case ShapeKind::cylinder:
      set_axisymmetric(mass * (3 * r * r + l * l) / 12, mass * r * r / 2);
      break;
    case ShapeKind::capsule: {
      const double cylinder = r * r * l, caps = 4.0 / 3 * r * r * r;  // volumes, divided by pi
      const double mc = mass * cylinder / (cylinder + caps), mh = mass - mc;
      set_axisymmetric(mc * (3 * r * r + l * l) / 12 + mh * (0.4 * r * r + l * l / 4 + 3.0 / 8 * l * r),
                       mc * r * r / 2 + mh * 0.4 * r * r);
      break;
    }
    default:
      set_axisymmetric(0.4 * mass * r * r, 0.4 * mass * r * r);
  }
  return i;
}

Inertia stretched_inertia(const Inertia& body, const Vec3& scale, double mass) {
  const Mat3 tensor = body.tensor();
  const Mat3 moments = 0.5 * tensor.trace() * Mat3::Identity() - tensor;  // integral of x x^T about the centre
  const Mat3 stretched = mass / body.mass * (scale.asDiagonal() * moments * scale.asDiagonal());
  return Inertia::from(mass, body.com.cwiseProduct(scale), stretched.trace() * Mat3::Identity() - stretched);
}

RobotTree single_body(const Shape& given, const std::string& mesh, const std::string& texture, const Inertia& inertia) {
  RobotTree tree;
  Shape shape = given;
  if (!mesh.empty()) shape.mesh = tree.intern(mesh);
  if (!texture.empty()) shape.texture = tree.intern(texture);
  tree.base("body");
  tree.set(keys::inertial, inertia);
  tree.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  tree.set_array(keys::visual_shapes, std::span<const Shape>(&shape, 1));
  tree.close();
  return tree;
}

}  // namespace muro::host
