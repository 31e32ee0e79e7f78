// SPDX-License-Identifier: MIT
#pragma once

namespace muro::render {

/// Throws Error when calls of OpenGL have failed since the last time. `doing`: the end of "OpenGL failed to ...". To be
/// called where the driver has to finish anyway: when something was made or is read back.
void check_gl(const char* doing);

}  // namespace muro::render
