// SPDX-License-Identifier: MIT
#include "collision_mesh.hpp"

#include "plugins/common/text/quote.hpp"

namespace muro::mesh {

void refuse_collision_mesh(Connector& c, ObjectId body, const Error& reason) {
  if (is_any_refused(c)) return;
  c.derived(world_object, key_refused);
  throw Error(quote(c.object_name(body)) + ": " + reason.what());
}

}  // namespace muro::mesh
