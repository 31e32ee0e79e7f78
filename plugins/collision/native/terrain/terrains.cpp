// SPDX-License-Identifier: MIT
#include "terrain/terrains.hpp"

#include <algorithm>

#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"

namespace muro::native {

void Terrains::connect(Connector& c) {
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) != no_robot) continue;
    for (const Shape& s : c.constant_array(object, keys::collision_shapes)) {
      if (s.kind != ShapeKind::heightmap) continue;
      try {
        const Heightmap map = store_.file(std::string(c.text(s.mesh))).heightmap(s.size);
        Aabb box = heightmap::bounds_of(map);
        box.low.z() -= heightmap::depth_of_ground;
        files_.push_back({&s, map, box});
      } catch (const Error& error) {
        mesh::refuse_collision_mesh(c, object, error);
      }
    }
  }
}

void Terrains::start(std::span<const Collider> colliders, double radius) {
  if (!by_collider_.empty() || files_.empty()) return;  // scenery does not move
  for (const Collider& c : colliders) {
    if (c.robot != no_robot) break;
    const auto file = std::find_if(files_.begin(), files_.end(), [&](const File& f) { return f.shape == c.shape; });
    by_collider_.push_back(file == files_.end() ? nullptr : &terrains_.emplace_back(file->map, c.pose(), radius));
  }
}

const Aabb* Terrains::box_of(const Shape& shape) const {
  for (const File& f : files_)
    if (f.shape == &shape) return &f.box;
  return nullptr;
}

}  // namespace muro::native
