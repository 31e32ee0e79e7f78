// SPDX-License-Identifier: MIT
#pragma once

#include "manifold.hpp"
#include "placed.hpp"

namespace muro::encounters {

/// The part of a shape's surface that lies outermost in some direction: a point, a straight line or a flat
/// face (a disc by the square in its rim).
struct Feature {
  int count = 0;               ///< 1, 2 or 4 points
  Vec3 points[4];              ///< m, world; those of a face in order around it
  Vec3 normal = Vec3::Zero();  ///< unit, of a face, outward
  Vec3 centre = Vec3::Zero();  ///< m, world
  double disc = 0;             ///< m, radius, when the face is a disc
  Vec3 tip = Vec3::Zero();     ///< m, world: an outermost point
  bool sharp = false;          ///< no other point is as far out as `tip`
};

/// Of a box, cylinder or capsule; `direction` is a unit vector. A box gives the face that looks most along the
/// direction, a cylinder its end or the line of its side that does.
Feature feature_towards(const Placed& shape, const Vec3& direction);

/// Adds the points where two features that are seen along `normal` (unit, from second to first) lie over each other:
/// both are projected along it and intersected, and the corners of the intersection are the points, each half way
/// between the features and with its own depth, as far as that is positive. None where one is a single point.
void add_overlap(const Feature& first, const Feature& second, const Vec3& normal, Manifold& out);

/// Adds the points of contact of two shapes that overlap by `depth` along `normal` (from second to first):
/// both features are projected along the normal, intersected, and where they overlap the corners of the
/// intersection are the points, each with its own depth. The deepest has `depth`.
void add_patch(const Feature& first, const Feature& second, const Vec3& normal, double depth, Manifold& out);

}  // namespace muro::encounters
