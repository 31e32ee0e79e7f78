// SPDX-License-Identifier: MIT
// Plugin collision_native: collision detection of primitive shapes, convex hulls and triangle meshes.
#include "muro/plugin.hpp"
#include "native_collision.hpp"

namespace {

using namespace muro;

constexpr Description description{
    .id = "collision.native",
    .kind = Kind::collision,
    .version = "1.2.0",
    .summary =
        "Contact points between boxes, spheres, cylinders, capsules, planes and meshes, in closed form where there is "
        "one",
    .parameters = contact_geometry::mesh_parameters,
    .reads = contact_geometry::collision_reads,
    .writes = contact_geometry::collision_writes,
    .capabilities = deterministic | allocation_free | restorable,
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<native::NativeCollision>(description)};

}  // namespace

MURO_PLUGIN(.name = "collision_native", .version = description.version, .licence = "MIT",
            .summary = "Collision detection of primitive shapes and meshes", .algorithms = algorithms)
