// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"

namespace muro::contact_geometry {

/// Makes points of contact as muro::Contact defines them of what an engine has found: half way between the two
/// surfaces, the normal from `b` to `a`, the depth positive; and enough of them for a stable support.
///
/// Convex pairs: several points of an engine are kept. Of a single one only the normal is kept: the depth along it is
/// computed anew from the shapes, and the points are the corners of the overlap of the features that face each other
/// (add_patch). A normal within half a degree of that of a face is replaced by the face's, if that is no deeper.
///
/// `b` an exact mesh: for each triangle its overlap with the feature of `a` that faces it; where the engine's normal
/// leans over a convex edge, the engine's point. Of points with one normal, to 8 degrees, at most eight are kept.
///
/// Changes `contacts`, adds to `points`.
void refine_contacts(const CollisionObject& a, const CollisionObject& b, std::vector<EngineContact>& contacts,
                     std::vector<ContactPoint>& points);

/// Of more than eight points with one normal, to 8 degrees, keeps the deepest and the outermost to seven sides; looks
/// at the points from number `first` on.
void keep_outermost(std::vector<ContactPoint>& points, std::size_t first);

}  // namespace muro::contact_geometry
