// SPDX-License-Identifier: MIT
#include "pairs/collide.hpp"
#include "pairs/penetration_depth.hpp"
#include "plugins/common/contact_geometry/feature.hpp"

namespace muro::native {
namespace {

/// Whether a face of `shape` separates it from `other`.
bool is_separated_by_face(const TransformedShape& shape, const TransformedShape& other) {
  const Vec3 d = other.centre - shape.centre;
  for (int k = shape.kind == ShapeKind::box ? 0 : 2; k < 3; ++k) {
    const Vec3 n = shape.axes.col(k);
    const double own = k == 2 && shape.kind == ShapeKind::capsule ? shape.half.z() + shape.radius() : shape.half[k];
    if (std::abs(n.dot(d)) >= own + extent_along(other, Vec3(other.axes.transpose() * n))) return true;
  }
  return false;
}

}  // namespace

void convex_convex(const TransformedShape& first, const TransformedShape& second, Manifold& out) {
  if (is_separated_by_face(first, second) || is_separated_by_face(second, first)) return;
  const Penetration penetration = penetration_depth(DepthFunction(first, second));
  if (penetration.depth <= 0) return;
  add_patch(feature_towards(first, -penetration.normal), feature_towards(second, penetration.normal),
            penetration.normal, penetration.depth, out);
}

}  // namespace muro::native
