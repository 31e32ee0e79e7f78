// SPDX-License-Identifier: MIT
// Rendering of depths and of the labels of objects. Must be made and used while the context is current.
#pragma once

#include "gpu_scene.hpp"
#include "program.hpp"
#include "target.hpp"

namespace muro::render {

class DepthRenderer {
 public:
  explicit DepthRenderer(GpuScene& scene);

  /// Draws what the camera sees into the rows of the target from `top` on, as many as the camera has. Must be called
  /// after the target's begin().
  void draw(const Camera& camera, const DepthTarget& target, std::uint32_t top = 0);

 private:
  GpuScene* scene_;
  Program depths_, labels_;
};

}  // namespace muro::render
