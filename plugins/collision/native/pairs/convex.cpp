// SPDX-License-Identifier: MIT
#include "pairs/collide.hpp"
#include "pairs/least_depth.hpp"
#include "plugins/common/contact_geometry/feature.hpp"

namespace muro::native {
namespace {

/// Whether a face of `shape` parts it from `other`.
bool apart_at_face(const Placed& shape, const Placed& other) {
  const Vec3 d = other.centre - shape.centre;
  for (int k = shape.kind == ShapeKind::box ? 0 : 2; k < 3; ++k) {
    const Vec3 n = shape.axes.col(k);
    const double own = k == 2 && shape.kind == ShapeKind::capsule ? shape.half.z() + shape.radius() : shape.half[k];
    if (std::abs(n.dot(d)) >= own + reach_along(other, Vec3(other.axes.transpose() * n))) return true;
  }
  return false;
}

}  // namespace

void convex_convex(const Placed& first, const Placed& second, Manifold& out) {
  if (apart_at_face(first, second) || apart_at_face(second, first)) return;
  const LeastDepth least = least_depth(DepthFunction(first, second));
  if (least.depth <= 0) return;
  add_patch(feature_towards(first, -least.normal), feature_towards(second, least.normal), least.normal, least.depth,
            out);
}

}  // namespace muro::native
