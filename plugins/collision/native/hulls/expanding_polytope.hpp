// SPDX-License-Identifier: MIT
#pragma once

#include "hulls/convex_core.hpp"
#include "pairs/penetration_depth.hpp"

namespace muro::native {

/// The least translation that separates two shapes given by their cores. Whether they overlap is decided by GJK; where
/// only the rounding does, the direction is GJK's. Where the cores do, it is found by a polytope inside of their
/// Minkowski difference, which is expanded where its surface is nearest to the origin (van den Bergen: Proximity
/// queries and penetration depth computation on 3D game objects, GDC 2001): exact for polyhedra, for cylinders to 1e-8
/// of the size. One of the cores has a volume, or the cores are apart, or nothing is found.
Penetration least_translation(const CorePair& pair);

}  // namespace muro::native
