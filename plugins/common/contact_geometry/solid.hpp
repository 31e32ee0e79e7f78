// SPDX-License-Identifier: MIT
#pragma once

#include "feature.hpp"
#include "plugins/common/mesh/hull.hpp"
#include "terrain.hpp"

namespace muro::encounters {

/// A shape as engines take it, in its own frame: a primitive, the hull of a mesh, or a mesh as it is.
struct Solid {
  Shape shape;                       ///< its origin has no meaning here
  const mesh::Hull* hull = nullptr;  ///< of a mesh that collides as its hull
  const Terrain* terrain = nullptr;  ///< of a mesh that collides as it is
  Aabb box;                          ///< m, of a mesh: around it
  bool is_plane() const { return shape.kind == ShapeKind::plane; }
};

/// A solid whose frame stands somewhere.
struct Standing {
  const Solid* solid = nullptr;
  Pose pose;
  Placed placed;  ///< of a mesh: the box around it
};

Standing standing(const Solid& solid, const Pose& pose);

/// As of a Placed, and of a hull the face that looks most along the direction, with at most four of its corners. Not of
/// a mesh as it is. Of a plane the face, `reach` (m) in all directions from the point of it nearest to `centre`.
Feature feature_towards(const Standing& s, const Vec3& direction, const Vec3& centre, double reach);

/// A point (m, world) of a convex solid that lies outermost along `direction` (unit); not of a plane.
Vec3 outermost(const Standing& s, const Vec3& direction);

/// How far (m) a point lies outside the surface; negative inside. Of a hull: outside the planes of its faces. Not of a
/// mesh as it is.
double height_over(const Standing& s, const Vec3& point);

/// How far (m) it reaches from the origin of its frame; a plane does not.
double reach_of(const Solid& solid);

}  // namespace muro::encounters
