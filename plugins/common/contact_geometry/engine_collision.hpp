// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "engine.hpp"
#include "pair_collision.hpp"
#include "per_thread.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::contact_geometry {

inline constexpr std::string_view mesh_options[] = {"convex", "exact"};
/// The parameters of every EngineCollision; its plugin's description names them.
inline constexpr Parameter engine_parameters[] = {
    text("meshes", "convex", "whether a mesh collides as its convex hull or, exact, as it is").one_of(mesh_options),
};

/// Collision detection whose narrow phase is that of an engine.
class EngineCollision : public PairCollision {
 public:
  explicit EngineCollision(std::unique_ptr<Engine> engine);
  ~EngineCollision() override;

  void connect(Connector& c) override;
  void start() override;

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  /// The numbers of a shape's geometries: as it collides, and its convex hull for pairs that need one.
  struct GeometryNumbers {
    std::uint32_t usual = none, convex = none;
  };
  struct Scratch;

  void ask_engine(const TransformedCollider& a, std::uint32_t number_a, const TransformedCollider& b,
                  std::uint32_t number_b, Scratch& scratch) const;
  TransformedShape transformed_shape(std::uint32_t collider) const override;
  void collide(const TransformedCollider& a, const TransformedCollider& b, std::vector<ContactPoint>& points) override;

  void add_geometries(Connector& c, ObjectId body, const Shape& shape, bool exact);
  void add_mesh(const std::string& path, const Shape& shape, bool exact, GeometryNumbers& numbers);
  std::uint32_t add_geometry(const CollisionGeometry& geometry);
  const mesh::Hull* hull_if_any(const std::string& path, const Vec3& scale);
  bool is_exact_mesh(std::uint32_t number) const { return geometries_[number].exact_mesh != nullptr; }
  void choose_geometries(const TransformedCollider& a, const TransformedCollider& b, std::uint32_t& number_a,
                         std::uint32_t& number_b) const;

  std::unique_ptr<Engine> engine_;
  PerThread<Scratch> scratch_;  ///< freed before the engine

  mesh::Store meshes_;
  std::deque<ExactMesh> exact_meshes_;
  std::deque<CollisionGeometry> geometries_;
  std::vector<std::pair<Shape, GeometryNumbers>> known_;            ///< each shape once
  std::vector<std::pair<const Shape*, GeometryNumbers>> by_shape_;  ///< sorted
  std::vector<GeometryNumbers> by_collider_;
  std::vector<std::string> names_;  ///< by object; empty for those without shapes
};

}  // namespace muro::contact_geometry
