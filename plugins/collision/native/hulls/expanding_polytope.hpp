// SPDX-License-Identifier: MIT
#pragma once

#include "hulls/convex_core.hpp"
#include "pairs/penetration_depth.hpp"

namespace muro::native {

/// Returns the least translation that separates two shapes given by their cores. GJK decides whether they overlap. If
/// only the rounding overlaps, GJK also gives the direction. If the cores overlap, a polytope inside their Minkowski
/// difference finds it: the polytope is expanded where its surface is nearest to the origin (van den Bergen: Proximity
/// queries and penetration depth computation on 3D game objects, GDC 2001). The result is exact for polyhedra, and for
/// cylinders to 1e-8 of the size. For cores that overlap, one must have a volume, or the polytope finds nothing.
Penetration least_translation(const CorePair& pair);

}  // namespace muro::native
