// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "core/registry.hpp"
#include "core/world_model.hpp"

namespace muro {

/// Reads a file with the reader of the registry for its type. Problems of severity error make a SetupError; the others
/// are kept in what is read. `packages`: folders of packages that the user has named. [any thread]
RobotTree read_model(Registry& registry, const std::string& path, std::span<const PackageFolder> packages = {});
/// The same for a file that describes a world. Errors in one of its models are left in the model's tree.
WorldModel read_world(Registry& registry, const std::string& path, std::span<const PackageFolder> packages = {});

}  // namespace muro
