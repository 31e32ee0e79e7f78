// SPDX-License-Identifier: MIT
#pragma once

#include "box_tree.hpp"
#include "feature.hpp"
#include "plugins/common/mesh/mesh.hpp"

namespace muro::encounters {

/// A mesh that is taken as it is, with what its triangles know of their neighbours.
class Terrain {
 public:
  explicit Terrain(const mesh::Mesh& surface);

  const mesh::Mesh& surface() const { return *surface_; }
  const Vec3& normal(std::size_t triangle) const { return sides_[triangle].normal; }
  /// Whether the mesh has an inside, so that it pushes along its normals only.
  bool closed() const { return closed_; }

  /// Whether a solid can be pushed off triangle number `triangle` along `n` (unit, in the frame of the mesh), to the
  /// side of it that n looks to: n leans over an edge only where the surface falls away behind it, and no farther than
  /// it does. Along other directions a neighbour is in the way: such normals are artefacts of looking at triangles one
  /// by one.
  bool allows(std::size_t triangle, const Vec3& n) const;

  /// The triangle nearest to a point (m, in the frame of the mesh) that is over or under it, at most `reach` (m) away;
  /// -1: there is none.
  std::int64_t triangle_at(const Vec3& point, double reach) const;

  /// The triangle as a face, when its mesh stands at `pose`; an open mesh looks to the side of `seen_from` (m, world).
  Feature face(std::size_t triangle, const Pose& pose, const Vec3& seen_from) const;

 private:
  struct Side {
    Vec3 normal;     ///< unit
    Vec3 out[3];     ///< unit, in the plane of the triangle, away from it over the edge behind corner k
    double lean[3];  ///< rad, by which the surface falls away behind that edge; a rim: pi
  };
  const mesh::Mesh* surface_;
  std::vector<Side> sides_;
  BoxTree tree_;  ///< of triangles
  bool closed_;
};

}  // namespace muro::encounters
