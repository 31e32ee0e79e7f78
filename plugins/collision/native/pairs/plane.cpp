// SPDX-License-Identifier: MIT
#include "lanes/plane_points.hpp"
#include "pairs/collide.hpp"

namespace muro::native {
namespace {

/// A transformed shape with the interface of lanes::ShapeInWorld.
struct KernelView {
  const TransformedShape& shape;

  KernelShapeKind kind() const { return KernelShapeKind(shape.kind); }
  const double* half() const { return shape.half.data(); }
  lane::V3<double> centre() const { return lane::splat<double>(shape.centre); }
  lane::V3<double> axis(int k) const { return lane::splat<double>(shape.axes.col(k)); }
};

}  // namespace

void solid_plane(const TransformedShape& solid, const TransformedShape& plane, Manifold& out) {
  const KernelView view{solid};
  const auto add = [&](bool below, const lane::V3<double>& point, double depth, int) {
    if (below) out.add({point.x, point.y, point.z}, plane.axis(), depth);
  };
  lanes::give_plane_points<double>(view, ground_plane_of(plane), add);
}

}  // namespace muro::native
