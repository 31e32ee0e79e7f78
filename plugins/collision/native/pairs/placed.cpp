// SPDX-License-Identifier: MIT
#include "pairs/placed.hpp"

#include <limits>

namespace muro::native {
namespace {

static_assert(int(Form::box) == int(ShapeKind::box) && int(Form::sphere) == int(ShapeKind::sphere) &&
              int(Form::cylinder) == int(ShapeKind::cylinder) && int(Form::capsule) == int(ShapeKind::capsule) &&
              int(Form::plane) == int(ShapeKind::plane) && int(Form::mesh) == int(ShapeKind::mesh));

/// The axis of the body that `v` is but for rounding, as Solid::along tells it.
int axis_along(const Vec3& v) {
  for (int k = 0; k < 3; ++k)
    if ((v - std::copysign(1.0, v[k]) * Vec3::Unit(k)).cwiseAbs().maxCoeff() < 1e-12) return v[k] > 0 ? k + 1 : -k - 1;
  return 0;
}

Vec3 vector(const lane::V3<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace

Solid solid_of(const Shape& shape, std::uint32_t body) {
  Solid s;
  s.form = Form(shape.kind);
  s.body = body;
  Vec3::Map(s.half) = half_of(shape);
  Vec3::Map(s.centre) = shape.origin.position;
  s.centred = shape.origin.position == Vec3::Zero();
  const Mat3 axes = shape.origin.orientation.toRotationMatrix();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = axes.col(k);
    s.along[k] = axis_along(axis);
    Vec3::Map(s.axes + 3 * k) = s.along[k] == 0 ? axis : Vec3(axis.array().round());
  }
  return s;
}

double reach_of(const Solid& solid) {
  constexpr double rounding = 1 + 1e-9;
  const Vec3 half = Vec3::Map(solid.half);
  const double away = Vec3::Map(solid.centre).norm();
  switch (solid.form) {
    case Form::box:
      return rounding * (away + half.norm());
    case Form::sphere:
      return rounding * (away + half.x());
    case Form::cylinder:
    case Form::capsule:
      return rounding * (away + half.x() + half.z());
    case Form::plane:
    case Form::mesh:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

Placed placed(const Solid& solid, const Pose& body) {
  const lanes::Body<double> at({{body.position.data()}}, solid.turns());
  const lanes::Standing<double> standing(solid, at);
  Placed p;
  p.kind = ShapeKind(solid.form);
  p.half = Vec3::Map(solid.half);
  p.centre = vector(standing.centre());
  if (solid.form == Form::sphere) return p;  // which looks the same from all sides
  for (int k = 0; k < 3; ++k) p.axes.col(k) = vector(standing.axis(k));
  return p;
}

Ground ground_of(const Placed& plane) {
  Ground g;
  Vec3::Map(g.normal) = plane.axis();
  Vec3::Map(g.origin) = plane.centre;
  g.level = plane.axis() == Vec3::UnitZ();
  return g;
}

}  // namespace muro::native
