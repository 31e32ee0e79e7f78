// SPDX-License-Identifier: MIT
// Rendering of colour images. Must be made and used while the context is current.
#pragma once

#include "gpu_scene.hpp"
#include "program.hpp"
#include "target.hpp"

namespace muro::render {

/// The light: a sun and a sky.
struct Daylight {
  Vec3 to_sun = Vec3(0.35, -0.5, 0.79).normalized();
  bool shadows = true;
  double shadow_range = 25;  ///< m, around the place that the camera sees; shadows are drawn within it
};

class ColorRenderer {
 public:
  explicit ColorRenderer(GpuScene& scene);
  ~ColorRenderer();
  ColorRenderer(const ColorRenderer&) = delete;
  ColorRenderer& operator=(const ColorRenderer&) = delete;

  void draw(const Camera& camera, const ColorTarget& target, const Daylight& light);

 private:
  void draw_shadows(const Camera& camera, const Daylight& light);
  void draw_sky(const Camera& camera) const;

  GpuScene* scene_;
  Program shadowed_color_, plain_color_, sky_, shadow_;
  std::uint32_t empty_array_ = 0;  ///< a vertex array without attributes
  std::uint32_t shadow_map_ = 0, shadow_framebuffer_ = 0;
  Eigen::Matrix4f shadow_matrix_ = Eigen::Matrix4f::Identity();
};

}  // namespace muro::render
