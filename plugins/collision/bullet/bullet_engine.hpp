// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/common/contact_geometry/engine.hpp"

class btCollisionShape;
class btStridingMeshInterface;

namespace muro::bullet_collision {

/// A Bullet shape and the triangles that it points to.
struct ShapeData {
  ShapeData();
  ShapeData(ShapeData&&) noexcept;
  ~ShapeData();
  std::unique_ptr<btStridingMeshInterface> triangles;
  std::unique_ptr<btCollisionShape> shape;
};

/// Bullet's collision library (Coumans) in double precision. An algorithm for each pair of kinds is created anew for
/// each pair, so that no manifold persists.
class BulletEngine final : public contact_geometry::Engine {
 public:
  void add(const contact_geometry::CollisionGeometry& geometry) override;
  std::unique_ptr<contact_geometry::NarrowPhase> make_narrow_phase() const override;

 private:
  std::vector<ShapeData> shapes_;  ///< by number of the geometry
};

}  // namespace muro::bullet_collision
