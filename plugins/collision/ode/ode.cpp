// SPDX-License-Identifier: MIT
// Plugin collision_ode: collision detection by the Open Dynamics Engine.
#include "muro/plugin.hpp"
#include "ode_engine.hpp"
#include "plugins/common/contact_geometry/engine_collision.hpp"

namespace {

using namespace muro;

constexpr Description description{
    .id = "collision.ode",
    .kind = Kind::collision,
    .version = "1.0.0",
    .summary = "Contact points by the Open Dynamics Engine: primitives, planes, convex hulls and meshes",
    .parameters = contact_geometry::mesh_parameters,
    .reads = contact_geometry::collision_reads,
    .writes = contact_geometry::collision_writes,
    .capabilities = deterministic | restorable,
};

class OdeCollision final : public contact_geometry::EngineCollision {
 public:
  OdeCollision() : EngineCollision(std::make_unique<ode_collision::OdeEngine>()) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<OdeCollision>(description)};

}  // namespace

MURO_PLUGIN(.name = "collision_ode", .version = description.version, .licence = "MIT",
            .summary = "Collision detection by the Open Dynamics Engine", .algorithms = algorithms)
