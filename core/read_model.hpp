// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "core/registry.hpp"
#include "core/world_model.hpp"

namespace muro {

/// Reads a file with the registry's reader for its type. Problems of severity error cause a SetupError; the result
/// keeps the others. `packages`: folders of packages that the user has named. [any thread]
RobotTree read_model(Registry& registry, const std::string& path, std::span<const PackageFolder> packages = {});
/// Reads a file that describes a world, in the same way. Errors in one of its models are kept in the model's tree.
WorldModel read_world(Registry& registry, const std::string& path, std::span<const PackageFolder> packages = {});

}  // namespace muro
