// SPDX-License-Identifier: MIT
// Pictures in colours. To be made and used while the context is current.
#pragma once

#include "program.hpp"
#include "stage.hpp"
#include "target.hpp"

namespace muro::render {

/// The light of pictures: a sun and a sky.
struct Daylight {
  Vec3 to_sun = Vec3(0.35, -0.5, 0.79).normalized();
  bool shadows = true;
  double shadow_range = 25;  ///< m: around what the camera looks at, shadows reach so far
};

class PictureRenderer {
 public:
  explicit PictureRenderer(Stage& stage);
  ~PictureRenderer();
  PictureRenderer(const PictureRenderer&) = delete;
  PictureRenderer& operator=(const PictureRenderer&) = delete;

  void draw(const Camera& camera, const ColorTarget& target, const Daylight& light);

 private:
  void draw_shadows(const Camera& camera, const Daylight& light);
  void draw_sky(const Camera& camera) const;

  Stage* stage_;
  Program picture_, sky_, shadow_;
  std::uint32_t none_ = 0;  ///< an array without attributes
  std::uint32_t shadow_map_ = 0, shadow_framebuffer_ = 0;
  Eigen::Matrix4f shadow_matrix_ = Eigen::Matrix4f::Identity();
};

}  // namespace muro::render
