// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/common/contact_geometry/engine.hpp"
#include "plugins/common/engines/ode/error_trap.hpp"
#include "plugins/common/engines/ode/ode_library.hpp"

namespace muro::ode_collision {

/// Data of a geom. Its arrays keep their addresses, because geoms point to them.
struct GeomPlan {
  const contact_geometry::CollisionGeometry* geometry = nullptr;
  Vec3 middle = Vec3::Zero();         ///< of a hull: origin of its polytope, because ODE needs the origin inside
  std::vector<dReal> planes, points;  ///< of a hull or box
  std::vector<unsigned> polygons;     ///< of a hull or box: count, corners, count, ...
  std::vector<dReal> vertices;        ///< of a mesh
  std::vector<dTriIndex> indices;     ///< of a mesh
  dTriMeshDataID mesh = nullptr;
};

/// The collision library of the Open Dynamics Engine (Smith): a collider for each pair of kinds.
class OdeEngine final : public contact_geometry::Engine {
 public:
  OdeEngine();
  ~OdeEngine() override;
  void use_log(Host& host) override;
  void add(const contact_geometry::CollisionGeometry& geometry) override;
  std::unique_ptr<contact_geometry::NarrowPhase> make_narrow_phase() const override;

 private:
  std::vector<std::unique_ptr<GeomPlan>> plans_;  ///< by number of the geometry
  std::unique_ptr<ode::MessageLog> messages_ = std::make_unique<ode::MessageLog>();
};

}  // namespace muro::ode_collision
