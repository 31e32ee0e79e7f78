// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/common/contact_geometry/engine.hpp"

class btCollisionShape;
class btStridingMeshInterface;

namespace muro::bullet_collision {

/// A shape of Bullet and what it points to.
struct Form {
  Form();
  Form(Form&&) noexcept;
  ~Form();
  std::unique_ptr<btStridingMeshInterface> triangles;
  std::unique_ptr<btCollisionShape> shape;
};

/// Bullet's collision library (Coumans), in double precision: an algorithm for each pair of kinds, made anew for each
/// pair, so that no manifold lives on.
class BulletEngine final : public encounters::Engine {
 public:
  void add(const encounters::Solid& solid) override;
  std::unique_ptr<encounters::Narrowphase> narrowphase() const override;

 private:
  std::vector<Form> forms_;  ///< by number of the solid
};

}  // namespace muro::bullet_collision
