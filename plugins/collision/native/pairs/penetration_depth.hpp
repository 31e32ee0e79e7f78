// SPDX-License-Identifier: MIT
#pragma once

#include "pairs/depth_function.hpp"

namespace muro::native {

struct Penetration {
  double depth = 0;  ///< m; not positive: the shapes are apart
  Vec3 normal;       ///< unit, from second to first: the direction of the minimum translation
};

/// Returns the minimum of the depth function over all directions.
///
/// The Minkowski difference is a sum of segments and discs. Its surface consists of flat faces (two segments, or a
/// disc), strips bent one way (a segment and an arc, or an arc and a corner) and, with two discs, patches bent both
/// ways. From inside, the nearest point of a convex surface lies where the surface has one normal. So it lies on one of
/// these parts, and each kind of part has its own search:
///
///  - flat: finitely many normals, as in the separating axis test (Gottschalk, Lin, Manocha: OBBTree, 1996);
///  - bent one way: the normals at right angles to one segment, a function on a circle, searched by
///    branch and bound: convexity gives h(m rotated by d) >= h(m) cos d - |h'(m)| sin d;
///  - bent both ways: branch and bound on the sphere by the same inequality, then Newton's method.
///
/// A minimum at the normal of a face is usually found first, and can be proven: a ball of that radius about the support
/// point of one shape lies in the other. Then the search ends.
///
/// If the cores of capsules are apart but their radius closes the gap, there is only one minimum. Newton's method finds
/// it, starting from the direction that GJK gives.
Penetration penetration_depth(const DepthFunction& h);

}  // namespace muro::native
