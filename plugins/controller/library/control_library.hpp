// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro_controller.h"

namespace muro::control {

/// Where a library given by its bare name is searched, in this order: `scenario_folder`, the folders of the
/// environment's MURO_CONTROLLER_PATH (separated by colons), and `controllers` beside this plugin.
std::vector<std::string> search_folders(const std::string& scenario_folder);

/// The path of a library. `name` is a path when it has a slash: then the file is `as_path`. Otherwise it is
/// searched as it is (if it ends in .so), else as NAME.so and libNAME.so. Throws Error with the places searched.
std::string find_library(std::string_view name, const std::string& as_path, std::span<const std::string> folders);

/// Loads a library, once for any number of calls, and checks its table, which is returned with all of its fields. It
/// stays loaded for the life of the process. Throws Error.
muro_controller_table load_library(const std::string& path);

}  // namespace muro::control
