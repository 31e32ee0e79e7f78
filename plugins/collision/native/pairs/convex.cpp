// SPDX-License-Identifier: MIT
#include "pairs/collide.hpp"
#include "pairs/feature.hpp"
#include "pairs/least_depth.hpp"

namespace muro::native {

void convex_convex(const Placed& first, const Placed& second, Manifold& out) {
  const LeastDepth least = least_depth(DepthFunction(first, second));
  if (least.depth <= 0) return;
  add_patch(feature_towards(first, -least.normal), feature_towards(second, least.normal), least.normal, least.depth,
            out);
}

}  // namespace muro::native
