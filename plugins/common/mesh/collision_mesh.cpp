// SPDX-License-Identifier: MIT
#include "collision_mesh.hpp"

#include "plugins/common/text/quote.hpp"

namespace muro::mesh {
namespace {

/// On the world object: an algorithm has reported a collision mesh. It is there in a set-up that fails, and only there.
constexpr Key<std::uint32_t> key_refused{"mesh.refused", "1", "a collision mesh cannot be used"};

}  // namespace

void refuse_collision_mesh(Connector& c, ObjectId body, const Error& reason) {
  if (c.is_used(world_object, key_refused, usage::derived)) return;
  c.derived(world_object, key_refused);
  throw Error(quote(c.object_name(body)) + ": " + reason.what());
}

}  // namespace muro::mesh
