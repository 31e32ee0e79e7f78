// SPDX-License-Identifier: MIT
#include "method.hpp"

#include "muro/vocabulary.hpp"

namespace muro::raycast {

void Raycast::connect(Connector& c) {
  scene_ = c.read(world_object, keys::scene_index);
  kernels_ = &scan_kernels_for(lane::best_isa());
}

void Raycast::prepare(std::span<const RaySet> sets) {
  patterns_.clear();
  for (const RaySet& set : sets) patterns_.emplace_back(set);
}

/// Takes over shapes at the first time, and where robots are now.
void Raycast::look() {
  if (built_) return table_.update(*scene_);
  table_.build(*scene_);
  built_ = true;
}

void Raycast::cast(std::size_t set, const View& view, std::span<double> ranges, std::span<ObjectId> hits) {
  thread_local Caster caster;
  caster.cast(*kernels_, table_, view, patterns_[set], ranges, hits);
}

Meshes meshes_of(const Connector& c) {
  Meshes m;
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& shape : c.constant_array(ObjectId(i), keys::collision_shapes)) {
      if (shape.kind != ShapeKind::mesh) continue;
      if (++m.count == 1) m.first = c.object_name(ObjectId(i));
    }
  return m;
}

}  // namespace muro::raycast
