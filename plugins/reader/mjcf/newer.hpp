// SPDX-License-Identifier: MIT
// Files for later versions of MuJoCo than the one at hand: attributes that it does not know and that can be left out.
#pragma once

#include "plugins/common/model_file/problems.hpp"

namespace muro::mjcf {

/// Adds what later versions take for granted: `autolimits`. Takes out of `text` what `error`, the words of MuJoCo's
/// compiler, does not know, where a later version knows it and the model is much the same without it; as blanks, so
/// that lines stay. False where that is not so.
bool leave_out_newer(std::string& text, const std::string& error, model_file::Problems& problems);

}  // namespace muro::mjcf
