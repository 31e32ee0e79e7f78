// SPDX-License-Identifier: MIT
#pragma once

#include <ode/ode.h>

#include "plugins/common/contact_geometry/engine.hpp"

namespace muro::ode_collision {

/// What makes the geom of a solid; its arrays stay where they are, for geoms point to them.
struct GeomPlan {
  const encounters::Solid* solid = nullptr;
  std::vector<dReal> planes, points;  ///< of a hull or box
  std::vector<unsigned> polygons;     ///< of the same: count, corners, count, ...
  std::vector<dReal> vertices;        ///< of a mesh
  std::vector<dTriIndex> indices;     ///< of a mesh
  dTriMeshDataID mesh = nullptr;
};

/// The collision library of the Open Dynamics Engine (Smith): a collider for each pair of kinds.
class OdeEngine final : public encounters::Engine {
 public:
  OdeEngine();
  ~OdeEngine() override;
  void add(const encounters::Solid& solid) override;
  std::unique_ptr<encounters::Narrowphase> narrowphase() const override;

 private:
  std::vector<std::unique_ptr<GeomPlan>> plans_;  ///< by number of the solid
};

}  // namespace muro::ode_collision
