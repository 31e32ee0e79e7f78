// SPDX-License-Identifier: MIT
#pragma once

namespace muro::render {

/// Throws Error if calls of OpenGL have failed since the last check. `doing`: the end of "OpenGL failed to ...". Should
/// be called where the driver has to finish anyway: after something was made or is read back.
void check_gl(const char* doing);

}  // namespace muro::render
