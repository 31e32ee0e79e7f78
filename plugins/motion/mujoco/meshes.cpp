// SPDX-License-Identifier: MIT
#include "meshes.hpp"

namespace muro::mujoco {

void Meshes::load(const Connector& connector) {
  hulls_.clear();
  for (std::uint32_t i = 0; i < connector.object_count(); ++i)
    for (const Shape& s : connector.constant_array(ObjectId{i}, keys::collision_shapes))
      if (s.kind == ShapeKind::mesh && !hulls_.contains(key_of(s)))
        hulls_[key_of(s)] = &store_.hull(std::string(connector.text(s.mesh)), s.size);
}

std::span<const Vec3> Meshes::hull_of(const Shape& shape) const {
  const auto found = hulls_.find(key_of(shape));
  if (shape.kind != ShapeKind::mesh || found == hulls_.end()) return {};
  return found->second->vertices;
}

}  // namespace muro::mujoco
