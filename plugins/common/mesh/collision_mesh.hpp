// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"

namespace muro::mesh {

/// Property of the world object, only in a set-up that fails: an algorithm has reported a collision mesh.
inline constexpr Key<std::uint32_t> key_refused{"mesh.refused", "1", "a collision mesh cannot be used"};

/// Whether an algorithm that connected before has refused a collision mesh. Then the set-up fails, and other remarks on
/// meshes would hide the reason. [setup]
inline bool is_any_refused(const Connector& c) { return c.is_used(world_object, key_refused, usage::derived); }

/// Must be called in connect if a collision mesh of `body` cannot be used. Throws muro::Error with the name of the body
/// and `reason`. If an algorithm that connected before has done so, it only returns, so that the user reads only the
/// first cause and not its consequences. The set-up fails in any case, and the caller goes on without the shape.
/// [setup]
void refuse_collision_mesh(Connector& c, ObjectId body, const Error& reason);

}  // namespace muro::mesh
