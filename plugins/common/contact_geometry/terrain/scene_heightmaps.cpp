// SPDX-License-Identifier: MIT
#include "scene_heightmaps.hpp"

#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"

namespace muro::terrain_contact {

void SceneHeightmaps::load(Connector& c) {
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) != no_robot) continue;
    for (const Shape& s : c.constant_array(object, keys::collision_shapes)) {
      if (s.kind != ShapeKind::heightmap || files_.contains(s.mesh)) continue;
      try {
        files_[s.mesh] = &store_.file(std::string(c.text(s.mesh)));
      } catch (const Error& error) {
        mesh::refuse_collision_mesh(c, object, error);
      }
    }
  }
}

}  // namespace muro::terrain_contact
