// SPDX-License-Identifier: MIT
#include "lanes/plane_points.hpp"
#include "pairs/collide.hpp"
#include "pairs/kernel_view.hpp"

namespace muro::native {
void solid_plane(const TransformedShape& solid, const TransformedShape& plane, Manifold& out) {
  const KernelView view{solid};
  const auto add = [&](bool below, const lane::V3<double>& point, double depth, int) {
    if (below) out.add({point.x, point.y, point.z}, plane.axis(), depth);
  };
  lanes::give_plane_points<double>(view, ground_plane_of(plane), add);
}

}  // namespace muro::native
