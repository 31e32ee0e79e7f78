// SPDX-License-Identifier: MIT
// Plugin scene_bvh: the spatial index of the scene.
#include "muro/plugin.hpp"
#include "scene_bvh.hpp"

namespace {

using namespace muro;

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<bvh::SceneBvh>(bvh::description)};

}  // namespace

MURO_PLUGIN(.name = "scene_bvh", .version = bvh::version, .licence = "MIT", .summary = "Spatial index of the scene",
            .algorithms = algorithms)
