// SPDX-License-Identifier: MIT
#include "pairs/separation_bound.hpp"

#include <algorithm>

namespace muro::native {
namespace {

double reach(const TransformedShape& shape, const Vec3& n) {
  return shape.kind == ShapeKind::sphere ? shape.radius() : extent_along(shape, Vec3(shape.axes.transpose() * n));
}

}  // namespace

double separation_bound(const TransformedShape& first, const TransformedShape& second) {
  const Vec3 d = second.centre - first.centre;
  double most = 0;
  const auto consider = [&](const Vec3& n) {
    most = std::max(most, std::abs(n.dot(d)) - reach(first, n) - reach(second, n));
  };
  for (const TransformedShape* shape : {&first, &second}) {
    if (shape->kind == ShapeKind::sphere) continue;
    for (int k = is_boxed(*shape) ? 0 : 2; k < 3; ++k) consider(shape->axes.col(k));
    if (shape->kind != ShapeKind::cylinder && shape->kind != ShapeKind::capsule) continue;
    const Vec3 u = shape->axis(), aside = d - u.dot(d) * u;
    if (const double length = aside.norm(); length > 0) consider(aside / length);
  }
  if (const double length = d.norm(); length > 0) consider(d / length);
  return most;
}

}  // namespace muro::native
