// SPDX-License-Identifier: MIT
// Contact points of two shapes that overlap: one function for each pair of kinds, and the switch between them.
//
// Every function takes the shapes in the order of its name and *adds* to an empty manifold. The normal points from
// second to first. The depth of the deepest point is the penetration depth: the length of the shortest translation of
// the first shape that separates the two. Against planes, and in the inner points of a manifold, it is the overlap at
// that point. The functions have no state and allocate nothing. Equal input gives equal bits.
#pragma once

#include "pairs/conversions.hpp"
#include "plugins/common/contact_geometry/manifold.hpp"

namespace muro::native {

/// Collides any two shapes except meshes; two planes never touch.
void collide_shapes(const TransformedShape& first, const TransformedShape& second, Manifold& out);

// plane.cpp: any shape except a plane or mesh.
void solid_plane(const TransformedShape& solid, const TransformedShape& plane, Manifold& out);

// round.cpp: pairs whose nearest points have a closed form.
void sphere_sphere(const TransformedShape& first, const TransformedShape& second, Manifold& out);
void box_sphere(const TransformedShape& box, const TransformedShape& sphere, Manifold& out);
void sphere_cylinder(const TransformedShape& sphere, const TransformedShape& cylinder, Manifold& out);
void sphere_capsule(const TransformedShape& sphere, const TransformedShape& capsule, Manifold& out);
void capsule_capsule(const TransformedShape& first, const TransformedShape& second, Manifold& out);

// box_box.cpp: separating axes and clipping.
void box_box(const TransformedShape& first, const TransformedShape& second, Manifold& out);

// convex.cpp: box-cylinder, box-capsule, cylinder-cylinder, cylinder-capsule, in either order.
void convex_convex(const TransformedShape& first, const TransformedShape& second, Manifold& out);

}  // namespace muro::native
