// SPDX-License-Identifier: MIT
#pragma once

#include "pairs/conversions.hpp"

namespace muro::native {

/// A distance (m) that two shapes are apart at least, of a mesh the box around it: the most that a normal of a face or
/// the line through the centres separates them by. Not positive: none of those does. Neither is a plane.
double separation_bound(const TransformedShape& first, const TransformedShape& second);

}  // namespace muro::native
