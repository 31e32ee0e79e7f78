// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro {

/// Shell command that runs the program with the plugins of this build.
inline const std::string muro_program = std::string("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

}  // namespace muro
