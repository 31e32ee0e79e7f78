// SPDX-License-Identifier: MIT
#include "mesh_warning.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::native {

void warn_of_meshes(Connector& c) {
  if (mesh::is_any_refused(c)) return;
  std::vector<TextId> warned;
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes)) {
      if (s.kind != ShapeKind::mesh || std::find(warned.begin(), warned.end(), s.mesh) != warned.end()) continue;
      warned.push_back(s.mesh);
      c.host().log(LogLevel::warning,
                   quote(c.object_name(ObjectId{i})) + ": mesh " + std::string(c.text(s.mesh)) +
                       " collides with nothing, for collision.native knows no meshes; use collision.bullet, "
                       "collision.ode or collision.fcl, or give the body boxes, spheres, cylinders or capsules");
    }
}

}  // namespace muro::native
