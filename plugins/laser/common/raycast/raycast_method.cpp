// SPDX-License-Identifier: MIT
#include "raycast_method.hpp"

#include "muro/vocabulary.hpp"

namespace muro::raycast {

void Raycast::connect(Connector& c) {
  scene_ = c.read(world_object, keys::scene_index);
  kernels_ = &scan_kernels_for(lane::best_isa());
  heightmaps_.connect(c);
}

void Raycast::prepare(std::span<const RaySet> sets) {
  patterns_.clear();
  for (const RaySet& set : sets) patterns_.emplace_back(set);
}

/// Copies the shapes the first time, and the poses of robots each time.
void Raycast::update() {
  if (built_) return table_.update(*scene_);
  table_.build(*scene_, heightmaps_);
  built_ = true;
}

void Raycast::cast(std::size_t set, const Viewpoint& from, std::span<double> ranges, std::span<ObjectId> hits) {
  thread_local RayCaster caster;
  caster.cast(*kernels_, table_, from, patterns_[set], ranges, hits);
}

MeshCount count_meshes(const Connector& c) {
  MeshCount meshes;
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& shape : c.constant_array(ObjectId(i), keys::collision_shapes)) {
      if (shape.kind != ShapeKind::mesh) continue;
      if (++meshes.count == 1) meshes.first_object = c.object_name(ObjectId(i));
    }
  return meshes;
}

}  // namespace muro::raycast
