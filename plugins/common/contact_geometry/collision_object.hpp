// SPDX-License-Identifier: MIT
#pragma once

#include "exact_mesh.hpp"
#include "feature.hpp"
#include "plugins/common/mesh/hull.hpp"

namespace muro::contact_geometry {

/// A shape in the form of collision engines, in its own frame: a primitive, the convex hull of a mesh, or an exact
/// mesh.
struct CollisionGeometry {
  Shape shape;                            ///< its origin is not used
  const mesh::Hull* hull = nullptr;       ///< of a mesh that collides as its convex hull
  const ExactMesh* exact_mesh = nullptr;  ///< of a mesh that collides triangle by triangle
  Aabb box;                               ///< m, bounds of a mesh
  bool is_plane() const { return shape.kind == ShapeKind::plane; }
};

/// A geometry at a pose.
struct CollisionObject {
  const CollisionGeometry* geometry = nullptr;
  Pose pose;
  TransformedShape shape;  ///< at the pose; for a mesh its bounding box
};

CollisionObject collision_object(const CollisionGeometry& geometry, const Pose& pose);

/// Does the same as feature_towards() of a TransformedShape. Of the faces about its support point, a hull gives the one
/// whose normal is nearest to the direction, with at most four of its corners. A plane gives a square that reaches
/// `reach` (m) to all sides from its point nearest to `centre`. Not for exact meshes.
Feature feature_towards(const CollisionObject& object, const Vec3& direction, const Vec3& centre, double reach);

/// Returns a support point (m, world): a point of a convex geometry that lies farthest along `direction` (unit). Not
/// for planes.
Vec3 support_point(const CollisionObject& object, const Vec3& direction);

/// Returns the distance (m) of a point from the surface, negative inside; for a hull, from the planes of its faces. Not
/// for exact meshes.
double signed_distance(const CollisionObject& object, const Vec3& point);

/// Returns the radius (m) of a ball about the origin of the geometry's frame that holds the geometry; 0 for a plane.
double bounding_radius(const CollisionGeometry& geometry);

}  // namespace muro::contact_geometry
