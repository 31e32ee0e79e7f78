// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "muro/scene.hpp"

namespace muro::contact_geometry {

/// Returns a lower bound (m) of the distance of two boxes; negative where they overlap.
inline double gap_between(const Aabb& a, const Aabb& b) {
  return std::max((a.low - b.high).maxCoeff(), (b.low - a.high).maxCoeff());
}

}  // namespace muro::contact_geometry
