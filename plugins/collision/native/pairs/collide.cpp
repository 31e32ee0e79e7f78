// SPDX-License-Identifier: MIT
#include "pairs/collide.hpp"

#include <utility>

namespace muro::native {
namespace {

constexpr int pair_of(ShapeKind a, ShapeKind b) { return int(a) * 8 + int(b); }

/// Collides two shapes whose kinds are in the order of ShapeKind.
void ordered(const TransformedShape& a, const TransformedShape& b, Manifold& out) {
  using enum ShapeKind;
  switch (pair_of(a.kind, b.kind)) {
    case pair_of(box, box):
      return box_box(a, b, out);
    case pair_of(box, sphere):
      return box_sphere(a, b, out);
    case pair_of(box, plane):
    case pair_of(sphere, plane):
    case pair_of(cylinder, plane):
    case pair_of(capsule, plane):
      return solid_plane(a, b, out);
    case pair_of(sphere, sphere):
      return sphere_sphere(a, b, out);
    case pair_of(sphere, cylinder):
      return sphere_cylinder(a, b, out);
    case pair_of(sphere, capsule):
      return sphere_capsule(a, b, out);
    case pair_of(capsule, capsule):
      return capsule_capsule(a, b, out);
    case pair_of(box, cylinder):
    case pair_of(box, capsule):
    case pair_of(cylinder, cylinder):
    case pair_of(cylinder, capsule):
      return convex_convex(a, b, out);
    default:
      return;  // two planes, meshes, heightmaps
  }
}

}  // namespace

void collide_shapes(const TransformedShape& first, const TransformedShape& second, Manifold& out) {
  if (first.kind <= second.kind) {
    ordered(first, second, out);
  } else {
    ordered(second, first, out);
    out.flip();
  }
}

}  // namespace muro::native
