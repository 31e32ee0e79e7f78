// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "pairs/conversions.hpp"
#include "plugins/common/contact_geometry/manifold.hpp"

namespace muro::native {

/// Adds the vertices of a hull that lie below a plane. Each point is half way between vertex and plane. Of more than
/// eight points it adds the deepest and the outermost. `body`: pose of the body of the hull.
void add_hull_on_plane(const KernelShape& hull, const Pose& body, const TransformedShape& plane,
                       std::vector<ContactPoint>& points);

}  // namespace muro::native
