// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include "plugins/common/contact_geometry/engine.hpp"

namespace muro::fcl_collision {

/// The Flexible Collision Library (Pan, Chitta and Manocha, ICRA 2012): its own solvers for pairs of primitives, GJK
/// and EPA for the others, hierarchies of boxes for meshes.
class FclEngine final : public encounters::Engine {
 public:
  void add(const encounters::Solid& solid) override;
  std::unique_ptr<encounters::Narrowphase> narrowphase() const override;

 private:
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> geometries_;  ///< by number of the solid
};

}  // namespace muro::fcl_collision
