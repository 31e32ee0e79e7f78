// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"

namespace muro::contact_geometry {

/// Converts contacts that an engine has found to points as muro::Contact defines them: half way between the two
/// surfaces, the normal from `b` to `a`, the depth positive; and enough points for a stable support.
///
/// Convex pairs: several points of an engine are kept. Of a single point only the normal is kept. The depth along it is
/// computed again from the shapes, and the points are the corners of the overlap of the features that face each other
/// (add_patch). A normal within half a degree of a face's normal is replaced by that one, if it is no deeper.
///
/// `b` is an exact mesh: each triangle gives its overlap with the feature of `a` that faces it. If the engine's normal
/// leans over a convex edge, it gives the engine's point. Of points with one normal, to 8 degrees, at most eight are
/// kept.
///
/// Changes `contacts`, and adds to `points`.
void refine_contacts(const CollisionObject& a, const CollisionObject& b, std::vector<EngineContact>& contacts,
                     std::vector<ContactPoint>& points);

/// Reduces more than eight points with one normal, to 8 degrees, to the deepest one and the outermost ones to seven
/// sides. Considers the points from number `first` on.
void keep_outermost(std::vector<ContactPoint>& points, std::size_t first);

}  // namespace muro::contact_geometry
