// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include "plugins/common/contact_geometry/engine.hpp"

namespace muro::fcl_collision {

/// The Flexible Collision Library (Pan, Chitta and Manocha, ICRA 2012). It has its own solvers for pairs of primitives,
/// GJK and EPA for the other pairs, and hierarchies of boxes for meshes.
class FclEngine final : public contact_geometry::Engine {
 public:
  bool takes_heightmaps_as_meshes() const override { return true; }
  void add(const contact_geometry::CollisionGeometry& geometry) override;
  std::unique_ptr<contact_geometry::NarrowPhase> make_narrow_phase() const override;

 private:
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> geometries_;  ///< by number of the geometry
};

}  // namespace muro::fcl_collision
