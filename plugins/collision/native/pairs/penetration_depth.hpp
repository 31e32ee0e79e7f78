// SPDX-License-Identifier: MIT
#pragma once

#include "pairs/depth_function.hpp"

namespace muro::native {

struct Penetration {
  double depth = 0;  ///< m; not positive: the shapes are apart
  Vec3 normal;       ///< unit, from second to first: the direction of the minimum translation
};

/// The minimum of the depth function over all directions.
///
/// The Minkowski difference is a sum of segments and discs. Its surface consists of flat faces (two segments,
/// or a disc), strips bent one way (a segment and an arc, or an arc and a corner) and, with two discs,
/// patches bent both ways. From inside, the nearest point of a convex surface lies where the surface has
/// one normal, so on one of these, and each is searched by its own means:
///
///  - flat: finitely many normals, as in the separating axis test (Gottschalk, Lin, Manocha: OBBTree, 1996);
///  - bent one way: the normals at right angles to one segment, a function on a circle, searched by
///    branch and bound: convexity gives h(m rotated by d) >= h(m) cos d - |h'(m)| sin d;
///  - bent both ways: branch and bound on the sphere by the same inequality, then Newton's method.
///
/// A minimum at the normal of a face is mostly found first, and can be proven: a ball of that radius about the support
/// point of one shape lies in the other. Then the search ends.
///
/// Where the cores of capsules are apart but their radius closes the gap, the minimum is the only one, and Newton's
/// method goes to it from the direction that GJK gives.
Penetration penetration_depth(const DepthFunction& h);

}  // namespace muro::native
