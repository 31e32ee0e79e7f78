// SPDX-License-Identifier: MIT
#pragma once

#include "muro/connector.hpp"

namespace muro::native {

/// Tells the user, once a file, of meshes among the collision shapes: collision.native leaves them out. [setup]
void warn_of_meshes(Connector& c);

}  // namespace muro::native
