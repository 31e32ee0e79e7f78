// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "hulls/hull_support.hpp"
#include "pairs/conversions.hpp"
#include "plugins/common/contact_geometry/geometry_table.hpp"

namespace muro::native {

using namespace contact_geometry;

/// Adds where two geometries overlap; `hull_a`, `hull_b`: of those that are hulls. Only `b` may be a plane, then `a` is
/// a hull, or an exact mesh.
void collide_geometries(const CollisionObject& a, const HullSupport* hull_a, const CollisionObject& b,
                        const HullSupport* hull_b, std::vector<ContactPoint>& points);

/// The narrow phase of pairs of which one at least is a mesh, but for planes. [collide: any thread]
class MeshPairs {
 public:
  /// Reads the meshes of the scene; without one it does nothing. [setup]
  void connect(Connector& c, bool exact);
  /// [setup]
  void start(std::span<const Collider> colliders);

  bool any() const { return geometries_.size() > 0; }
  /// A mesh as kernels take it: the box around it, and the vertices of its hull, if it has one. [setup]
  KernelShape kernel_shape(std::uint32_t collider, const Shape& mesh, std::uint32_t body);

  struct HullOf {
    const CollisionGeometry* geometry = nullptr;  ///< null: it has none
    const HullSupport* support = nullptr;
  };
  /// The convex hull of a mesh, by the number of its collider.
  HullOf hull_of(std::uint32_t collider) const;
  /// As PairCollision::collide.
  void collide(const TransformedCollider& a, const TransformedCollider& b, std::vector<ContactPoint>& points) const;

 private:
  /// The vertices of a hull in the frame of its body.
  struct Placed {
    const mesh::Hull* hull;
    Pose origin;  ///< of the shape
    std::vector<Vec3> vertices;
  };

  GeometryTable geometries_;
  std::deque<Placed> placed_;
  std::deque<HullSupport> hulls_;
  std::vector<const HullSupport*> hull_of_;  ///< by geometry; null: it is none
};

}  // namespace muro::native
