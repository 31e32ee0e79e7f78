// SPDX-License-Identifier: MIT
#pragma once

#include "ray_caster.hpp"

namespace muro::raycast {

/// Exact distances to the boxes, spheres, cylinders, capsules, planes and heightmaps of scene.index.
class Raycast final : public scanner::Method {
 public:
  void connect(Connector& c) override;
  void prepare(std::span<const RaySet> sets) override;
  void start() override { built_ = false; }
  void restored() override { built_ = false; }
  void update() override;
  void cast(std::size_t set, const Viewpoint& from, std::span<double> ranges, std::span<ObjectId> hits) override;
  bool is_parallel() const override { return true; }
  bool is_cheap_for_few_rays() const override { return true; }

 private:
  In<SceneIndex> scene_;
  std::vector<RayPattern> patterns_;
  const ScanKernels* kernels_ = nullptr;
  HeightTrees heightmaps_;
  SceneTable table_;
  bool built_ = false;
};

/// The number of meshes among the collision shapes, which this method does not see.
struct MeshCount {
  std::size_t count = 0;
  std::string_view first_object;
};
/// Counts the meshes. [setup]
MeshCount count_meshes(const Connector& c);

}  // namespace muro::raycast
