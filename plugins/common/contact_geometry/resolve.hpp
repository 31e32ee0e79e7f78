// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"

namespace muro::encounters {

/// From what an engine found to points of contact as muro::Contact defines them: half way between the two surfaces, the
/// normal from `b` to `a`, the depth positive; enough of them that a body stands on them.
///
/// Convex pairs: several points of an engine are taken over. A single one gives the normal alone: the depth along it is
/// worked out anew from the shapes, and the points are the corners where the features overlap that look at each other
/// (add_patch). A normal within half a degree of that of a face is the face's, when that is no deeper.
///
/// `b` a mesh as it is: for each triangle, its overlap with the feature of `a` that looks at it; where the engine's
/// normal leans over an edge behind which the surface falls away, the engine's point. Of points with one normal, to 8
/// degrees, at most eight are kept.
///
/// `touches` is used up. Adds to `points`.
void resolve(const Standing& a, const Standing& b, std::vector<Touch>& touches, std::vector<ContactPoint>& points);

}  // namespace muro::encounters
