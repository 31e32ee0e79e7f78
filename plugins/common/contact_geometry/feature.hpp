// SPDX-License-Identifier: MIT
#pragma once

#include "manifold.hpp"
#include "transformed_shape.hpp"

namespace muro::contact_geometry {

/// The part of a shape's surface that lies farthest in some direction: a vertex, an edge or a flat face (a disc is
/// represented by the square in its rim).
struct Feature {
  int count = 0;                ///< 1, 2 or 4 points
  Vec3 points[4];               ///< m, world; those of a face in order around it
  Vec3 normal = Vec3::Zero();   ///< unit, of a face, outward
  Vec3 centre = Vec3::Zero();   ///< m, world
  double disc_radius = 0;       ///< m, if the face is a disc
  Vec3 support = Vec3::Zero();  ///< m, world: a support point
  bool is_unique = false;       ///< no other point lies as far as `support`
};

/// Returns the feature of a box, cylinder or capsule. `direction` is a unit vector. A box gives the face whose normal
/// is nearest to the direction, a cylinder its end or the line of its side.
Feature feature_towards(const TransformedShape& shape, const Vec3& direction);

/// Adds the overlap of two features along `normal` (unit, from second to first). Both are projected along it and
/// intersected. The corners of the intersection are the points, each half way between the features and with its own
/// depth, if that is positive. If one feature is a single point, nothing is added.
void add_overlap(const Feature& first, const Feature& second, const Vec3& normal, Manifold& out);

/// Adds the contact patch of two shapes that overlap by `depth` along `normal` (from second to first): the overlap of
/// their features. The deepest point has `depth`.
void add_patch(const Feature& first, const Feature& second, const Vec3& normal, double depth, Manifold& out);

}  // namespace muro::contact_geometry
