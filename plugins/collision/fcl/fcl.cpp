// SPDX-License-Identifier: MIT
// Plugin collision_fcl: collision detection by FCL.
#include "fcl_engine.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/contact_geometry/engine_collision.hpp"

namespace {

using namespace muro;

constexpr Description description{
    .id = "collision.fcl",
    .kind = Kind::collision,
    .version = "1.0.0",
    .summary = "Contact points by FCL: primitives, planes, convex hulls and meshes",
    .parameters = contact_geometry::mesh_parameters,
    .reads = contact_geometry::collision_reads,
    .writes = contact_geometry::collision_writes,
    .capabilities = deterministic | restorable,
};

class FclCollision final : public contact_geometry::EngineCollision {
 public:
  FclCollision() : EngineCollision(std::make_unique<fcl_collision::FclEngine>()) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<FclCollision>(description)};

}  // namespace

MURO_PLUGIN(.name = "collision_fcl", .version = description.version, .licence = "MIT",
            .summary = "Collision detection by FCL", .algorithms = algorithms)
