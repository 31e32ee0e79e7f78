// SPDX-License-Identifier: MIT
#pragma once

#include "box_tree.hpp"
#include "feature.hpp"
#include "plugins/common/mesh/mesh.hpp"

namespace muro::contact_geometry {

/// A mesh that collides triangle by triangle, with the angles at the edges between its triangles.
class ExactMesh {
 public:
  explicit ExactMesh(const mesh::Mesh& surface);

  const mesh::Mesh& surface() const { return *surface_; }
  const Vec3& normal(std::size_t triangle) const { return triangles_[triangle].normal; }
  /// Whether the mesh has an inside. Then it pushes only along its normals.
  bool closed() const { return closed_; }

  /// Whether a contact with triangle number `triangle` may have the normal `n` (unit, in the frame of the mesh). It may
  /// lean over an edge only if the edge is convex, and no farther than the neighbour's normal does. Other normals are
  /// artefacts of testing triangles one by one.
  bool allows(std::size_t triangle, const Vec3& n) const;

  /// Calls `visit(number)` for triangles that a box (m, in the frame of the mesh) may touch.
  template <class Visit>
  void each_near(const Aabb& box, Visit visit) const {
    contact_geometry::each_near(tree_.view(), box, visit);
  }

  /// Returns the triangle nearest to a point (m, in the frame of the mesh) that is over or under the point, at most
  /// `reach` (m) away; -1: there is none.
  std::int64_t triangle_at(const Vec3& point, double reach) const;

  /// Returns the triangle as a face, with the mesh at `pose`. The normal of an open mesh points to the side of
  /// `seen_from` (m, world).
  Feature face(std::size_t triangle, const Pose& pose, const Vec3& seen_from) const;

 private:
  struct Triangle {
    Vec3 normal;           ///< unit
    Vec3 edge_normals[3];  ///< unit, in the plane of the triangle, outward over the edge behind corner k
    double max_lean[3];    ///< rad, between the normals at a convex edge, negative at a concave one; at a rim: pi
  };
  const mesh::Mesh* surface_;
  std::vector<Triangle> triangles_;
  BoxTree tree_;  ///< of triangles
  bool closed_;
};

}  // namespace muro::contact_geometry
