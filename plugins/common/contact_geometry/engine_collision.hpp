// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"
#include "geometry_table.hpp"
#include "per_thread.hpp"
#include "plugins/common/contact_geometry/terrain/scene_heightmaps.hpp"

namespace muro::contact_geometry {

/// Collision detection with the narrow phase of an engine. The description of its plugin has `mesh_parameters`.
class EngineCollision : public PairCollision {
 public:
  explicit EngineCollision(std::unique_ptr<Engine> engine);
  ~EngineCollision() override;

  void connect(Connector& c) override;
  void start() override;

 private:
  struct Scratch;

  void ask_engine(const TransformedCollider& a, std::uint32_t number_a, const TransformedCollider& b,
                  std::uint32_t number_b, Scratch& scratch) const;
  void collide_with_terrain(const TransformedCollider& a, const TransformedCollider& terrain,
                            std::vector<ContactPoint>& points) const;
  TransformedShape transformed_shape(std::uint32_t collider) const override;
  void collide(const TransformedCollider& a, const TransformedCollider& b, std::vector<ContactPoint>& points) override;

  std::unique_ptr<Engine> engine_;
  PerThread<Scratch> scratch_;  ///< freed before the engine

  GeometryTable geometries_;
  terrain_contact::SceneHeightmaps heightmaps_;  ///< heightmaps that the engine does not take
  std::vector<std::string> names_;               ///< by object; empty for objects without shapes
};

}  // namespace muro::contact_geometry
