// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "hulls/hull_support.hpp"
#include "pairs/conversions.hpp"
#include "plugins/common/contact_geometry/geometry_table.hpp"

namespace muro::native {

using namespace contact_geometry;

/// Adds the contact points of two geometries that overlap. `hull_a`, `hull_b`: supports of those that are hulls. Only
/// `b` may be a plane; then `a` is a hull or an exact mesh.
void collide_geometries(const CollisionObject& a, const HullSupport* hull_a, const CollisionObject& b,
                        const HullSupport* hull_b, std::vector<ContactPoint>& points);

/// Narrow phase of pairs with at least one mesh and no plane. [collide: any thread]
class MeshPairs {
 public:
  /// Reads the meshes of the scene; does nothing if there is none. [setup]
  void connect(Connector& c, bool exact);
  /// [setup]
  void start(std::span<const Collider> colliders);

  bool any() const { return geometries_.size() > 0; }
  /// Returns a mesh in the form of kernels: the box around it, and the vertices of its hull, if it has one. [setup]
  KernelShape kernel_shape(std::uint32_t collider, const Shape& mesh, std::uint32_t body);

  struct HullOf {
    const CollisionGeometry* geometry = nullptr;  ///< null: there is none
    const HullSupport* support = nullptr;
  };
  /// Returns the convex hull of a mesh, by the number of its collider.
  HullOf hull_of(std::uint32_t collider) const;
  /// Does what PairCollision::collide does.
  void collide(const TransformedCollider& a, const TransformedCollider& b, std::vector<ContactPoint>& points) const;

 private:
  /// The vertices of a hull in the frame of its body.
  struct Placed {
    const mesh::Hull* hull;
    Pose origin;  ///< pose of the shape in its body
    std::vector<Vec3> vertices;
  };

  GeometryTable geometries_;
  std::deque<Placed> placed_;
  std::deque<HullSupport> hulls_;
  std::vector<const HullSupport*> hull_of_;  ///< by geometry; null: not a hull
};

}  // namespace muro::native
