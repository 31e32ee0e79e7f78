// SPDX-License-Identifier: MIT
// Files for newer versions of MuJoCo than the linked one: removes unknown attributes that are not essential.
#pragma once

#include "plugins/common/model_file/problems.hpp"

namespace muro::mjcf {

/// Changes `text` so that the linked version of MuJoCo can read it. `error`: message of MuJoCo's compiler. Adds
/// `autolimits`, the default of newer versions. Replaces by blanks an unknown attribute that a newer version knows, if
/// the model is much the same without it; line numbers stay. Returns false if nothing can be changed.
bool leave_out_newer(std::string& text, const std::string& error, model_file::Problems& problems);

}  // namespace muro::mjcf
