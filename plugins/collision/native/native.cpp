// SPDX-License-Identifier: MIT
// Plugin collision_native: the spatial index and exact collision detection of primitive shapes.
#include "collision.hpp"
#include "muro/plugin.hpp"
#include "scene_bvh.hpp"

namespace {

using namespace muro;

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<native::SceneBvh>(native::scene_bvh_description),
                                              algorithm<native::NativeCollision>(native::collision_description)};

}  // namespace

MURO_PLUGIN(.name = "collision_native", .version = "1.1.0", .licence = "MIT",
            .summary = "Spatial index and collision detection of primitive shapes", .algorithms = algorithms)
