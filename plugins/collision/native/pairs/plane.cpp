// SPDX-License-Identifier: MIT
#include "lanes/plane_points.hpp"
#include "pairs/collide.hpp"

namespace muro::native {
namespace {

/// A placed shape as kernels ask for it.
struct View {
  const Placed& shape;

  Form form() const { return Form(shape.kind); }
  const double* half() const { return shape.half.data(); }
  lane::V3<double> centre() const { return lane::splat<double>(shape.centre); }
  lane::V3<double> axis(int k) const { return lane::splat<double>(shape.axes.col(k)); }
};

}  // namespace

void solid_plane(const Placed& solid, const Placed& plane, Manifold& out) {
  const View view{solid};
  const auto add = [&](bool below, const lane::V3<double>& point, double depth, int) {
    if (below) out.add({point.x, point.y, point.z}, plane.axis(), depth);
  };
  lanes::give_plane_points<double>(view, ground_of(plane), add);
}

}  // namespace muro::native
