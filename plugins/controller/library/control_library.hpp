// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro_controller.h"

namespace muro::control {

/// Returns the folders in which a library is searched by its bare name, in this order: `scenario_folder`, the folders
/// of the environment variable MURO_CONTROLLER_PATH (separated by colons), and `controllers` beside this plugin.
std::vector<std::string> search_folders(const std::string& scenario_folder);

/// Returns the path of a library. If `name` has a slash, the file is `as_path`. Else it is searched as it is (if it
/// ends in .so) or as NAME.so and libNAME.so. Throws Error with the places searched.
std::string find_library(std::string_view name, const std::string& as_path, std::span<const std::string> folders);

/// Loads a library, also when called several times, and checks its table. Returns the table with all of its fields. The
/// library stays loaded until the process ends. Throws Error.
muro_controller_table load_library(const std::string& path);

}  // namespace muro::control
