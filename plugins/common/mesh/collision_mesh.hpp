// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"

namespace muro::mesh {

/// On the world object, in a set-up that fails and only there: an algorithm has reported a collision mesh.
inline constexpr Key<std::uint32_t> key_refused{"mesh.refused", "1", "a collision mesh cannot be used"};

/// Whether an algorithm that connected before has refused a collision mesh: the set-up fails, and other remarks on
/// meshes would hide why. [setup]
inline bool is_any_refused(const Connector& c) { return c.is_used(world_object, key_refused, usage::derived); }

/// To be called in connect where a collision mesh of `body` cannot be used, with the reason. Throws muro::Error with
/// the name of the body and the reason. Where an algorithm that connected before has done so, it returns, so that the
/// user reads the first cause alone and not what follows from it; the set-up fails in any case, and the caller goes on
/// without the shape. [setup]
void refuse_collision_mesh(Connector& c, ObjectId body, const Error& reason);

}  // namespace muro::mesh
