// SPDX-License-Identifier: MIT
#include "pairs/conversions.hpp"

namespace muro::native {
namespace {

static_assert(int(KernelShapeKind::box) == int(ShapeKind::box) &&
              int(KernelShapeKind::sphere) == int(ShapeKind::sphere) &&
              int(KernelShapeKind::cylinder) == int(ShapeKind::cylinder) &&
              int(KernelShapeKind::capsule) == int(ShapeKind::capsule) &&
              int(KernelShapeKind::plane) == int(ShapeKind::plane) &&
              int(KernelShapeKind::mesh) == int(ShapeKind::mesh) &&
              int(KernelShapeKind::heightmap) == int(ShapeKind::heightmap));

/// Returns the axis of the body that `v` is, apart from rounding, numbered as in KernelShape::along.
int axis_along(const Vec3& v) {
  for (int k = 0; k < 3; ++k)
    if ((v - std::copysign(1.0, v[k]) * Vec3::Unit(k)).cwiseAbs().maxCoeff() < 1e-12) return v[k] > 0 ? k + 1 : -k - 1;
  return 0;
}

Vec3 vector(const lane::V3<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace

KernelShape kernel_shape_of(const Shape& shape, std::uint32_t body) {
  KernelShape s;
  s.kind = KernelShapeKind(shape.kind);
  s.body = body;
  Vec3::Map(s.half) = half_lengths(shape);
  Vec3::Map(s.centre) = shape.origin.position;
  s.is_centred = shape.origin.position == Vec3::Zero();
  const Mat3 axes = shape.origin.orientation.toRotationMatrix();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = axes.col(k);
    s.along[k] = axis_along(axis);
    Vec3::Map(s.axes + 3 * k) = s.along[k] == 0 ? axis : Vec3(axis.array().round());
  }
  return s;
}

KernelShape kernel_shape_of(const Shape& shape, const Aabb& box, std::uint32_t body) {
  Shape around = Shape::box(box.high - box.low);
  around.origin = shape.origin * Pose{0.5 * (box.low + box.high), Quat::Identity()};
  KernelShape s = kernel_shape_of(around, body);
  s.kind = KernelShapeKind(shape.kind);
  return s;
}

TransformedShape transformed(const KernelShape& shape, const Pose& body) {
  const BodyFrame<double> frame({{body.position.data()}}, shape.needs_orientation());
  const lanes::ShapeInWorld<double> world(shape, frame);
  TransformedShape p;
  p.kind = ShapeKind(shape.kind);
  p.half = Vec3::Map(shape.half);
  p.centre = vector(world.centre());
  if (shape.kind == KernelShapeKind::sphere) return p;  // its axes do not matter
  for (int k = 0; k < 3; ++k) p.axes.col(k) = vector(world.axis(k));
  return p;
}

GroundPlane ground_plane_of(const TransformedShape& plane) {
  GroundPlane g;
  Vec3::Map(g.normal) = plane.axis();
  Vec3::Map(g.origin) = plane.centre;
  g.is_level = plane.axis() == Vec3::UnitZ();
  return g;
}

}  // namespace muro::native
