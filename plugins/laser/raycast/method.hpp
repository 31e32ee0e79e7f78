// SPDX-License-Identifier: MIT
#pragma once

#include "caster.hpp"

namespace muro::raycast {

/// Exact distances to boxes, spheres, cylinders, capsules and planes, of scene.index.
class Raycast final : public scanner::Method {
 public:
  void connect(Connector& c) override;
  void prepare(std::span<const RaySet> sets) override;
  void start() override { built_ = false; }
  void restored() override { built_ = false; }
  void look() override;
  void cast(std::size_t set, const View& view, std::span<double> ranges, std::span<ObjectId> hits) override;
  bool is_parallel() const override { return true; }
  bool is_cheap_for_few() const override { return true; }

 private:
  In<SceneIndex> scene_;
  std::vector<Pattern> patterns_;
  const ScanKernels* kernels_ = nullptr;
  SceneTable table_;
  bool built_ = false;
};

/// How many meshes are among the collision shapes, and on which object the first is. [setup]
struct Meshes {
  std::size_t count = 0;
  std::string_view first;
};
Meshes meshes_of(const Connector& c);

}  // namespace muro::raycast
