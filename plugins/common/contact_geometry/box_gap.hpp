// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "muro/scene.hpp"

namespace muro::contact_geometry {

/// A distance (m) that two boxes are apart at least; negative where they overlap.
inline double gap_between(const Aabb& a, const Aabb& b) {
  return std::max((a.low - b.high).maxCoeff(), (b.low - a.high).maxCoeff());
}

}  // namespace muro::contact_geometry
