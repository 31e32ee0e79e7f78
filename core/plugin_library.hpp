// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "muro/detail/abi.hpp"

namespace muro {

/// Loads the shared library `path` and returns its table, which stays valid until the program ends. Throws SetupError
/// with the reason when it is no plugin, or a plugin that must not be used.
const abi::PluginTable& load_plugin(const std::string& path);

/// Returns the first field in which two stamps differ, in words; "" when a plugin with `theirs` may be used.
std::string difference(const abi::Stamp& ours, const abi::Stamp& theirs);

}  // namespace muro
