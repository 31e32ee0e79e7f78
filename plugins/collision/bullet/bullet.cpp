// SPDX-License-Identifier: MIT
// Plugin collision_bullet: collision detection by Bullet.
#include "bullet_engine.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/contact_geometry/engine_collision.hpp"

namespace {

using namespace muro;

constexpr Description description{
    .id = "collision.bullet",
    .kind = Kind::collision,
    .version = "1.0.0",
    .summary = "Contact points by Bullet: primitives, planes, convex hulls and meshes",
    .parameters = contact_geometry::mesh_parameters,
    .reads = contact_geometry::collision_reads,
    .writes = contact_geometry::collision_writes,
    .capabilities = deterministic | allocation_free | restorable,
};

class BulletCollision final : public contact_geometry::EngineCollision {
 public:
  BulletCollision() : EngineCollision(std::make_unique<bullet_collision::BulletEngine>()) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<BulletCollision>(description)};

}  // namespace

MURO_PLUGIN(.name = "collision_bullet", .version = description.version, .licence = "MIT",
            .summary = "Collision detection by Bullet", .algorithms = algorithms)
