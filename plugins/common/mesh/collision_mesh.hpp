// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"

namespace muro::mesh {

/// To be called in connect where a collision mesh of `body` cannot be used, with the reason. Throws muro::Error with
/// the name of the body and the reason. Where an algorithm that connected before has done so, it returns, so that the
/// user reads the first cause alone and not what follows from it; the set-up fails in any case, and the caller goes on
/// without the shape. [setup]
void refuse_collision_mesh(Connector& c, ObjectId body, const Error& reason);

}  // namespace muro::mesh
