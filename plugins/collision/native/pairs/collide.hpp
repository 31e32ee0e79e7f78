// SPDX-License-Identifier: MIT
// Where two shapes overlap: one function per pair of kinds, and the switch between them.
//
// Every function takes the shapes in the order of its name and *adds* to an empty manifold. The normal
// points from second to first. The depth of the deepest point is the least distance by which the first
// shape must be moved, in any direction, to be clear of the second (except against planes and in the inner
// points of a manifold, where it is the overlap at that point). No state, no allocation; equal input gives
// equal bits.
#pragma once

#include "pairs/placed.hpp"
#include "plugins/common/contact_geometry/manifold.hpp"

namespace muro::native {

/// Any two shapes but meshes; two planes never touch.
void collide(const Placed& first, const Placed& second, Manifold& out);

// plane.cpp: any shape but a plane or mesh.
void solid_plane(const Placed& solid, const Placed& plane, Manifold& out);

// round.cpp: pairs whose nearest points have a closed form.
void sphere_sphere(const Placed& first, const Placed& second, Manifold& out);
void box_sphere(const Placed& box, const Placed& sphere, Manifold& out);
void sphere_cylinder(const Placed& sphere, const Placed& cylinder, Manifold& out);
void sphere_capsule(const Placed& sphere, const Placed& capsule, Manifold& out);
void capsule_capsule(const Placed& first, const Placed& second, Manifold& out);

// box_box.cpp: separating axes and clipping.
void box_box(const Placed& first, const Placed& second, Manifold& out);

// convex.cpp: box-cylinder, box-capsule, cylinder-cylinder, cylinder-capsule, in either order.
void convex_convex(const Placed& first, const Placed& second, Manifold& out);

}  // namespace muro::native
