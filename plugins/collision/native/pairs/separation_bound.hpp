// SPDX-License-Identifier: MIT
#pragma once

#include "pairs/conversions.hpp"

namespace muro::native {

/// Returns a lower bound (m) of the distance of two shapes; a mesh counts as the box around it. It is the largest
/// separation along a normal of a face or the line through the centres. Not positive: none of these separates them.
/// Neither shape is a plane.
double separation_bound(const TransformedShape& first, const TransformedShape& second);

}  // namespace muro::native
