// SPDX-License-Identifier: MIT
// Draws a scene as a camera sees it. To be made and used while the context is current.
#pragma once

#include <array>
#include <memory>

#include "camera.hpp"
#include "program.hpp"
#include "scene.hpp"
#include "target.hpp"

namespace muro::render {

/// The light of pictures: a sun and a sky.
struct Daylight {
  Vec3 to_sun = Vec3(0.35, -0.5, 0.79).normalized();
  bool shadows = true;
  double shadow_range = 25;  ///< m: around what the camera looks at, shadows reach so far
};

class Renderer {
 public:
  explicit Renderer(const Scene& scene);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Distances and labels (ObjectId) of what the camera sees.
  void draw(const Camera& camera, const DepthTarget& target);
  void draw(const Camera& camera, const ColorTarget& target, const Daylight& light);

 private:
  /// One piece as the vertex shader gets it.
  struct Instance {
    std::array<float, 12> place{};  ///< rows of a 3x4 matrix: from the surface to the world, about the eye
    std::array<float, 3> color{};
    std::uint32_t label = 0;
    float pattern = 0;  ///< 1: tiles of a metre
  };
  /// Where the triangles of a surface lie in the buffers.
  struct Part {
    std::uint32_t first_index = 0, indices = 0;
    std::int32_t first_vertex = 0;
  };
  using Frustum = std::array<Eigen::Vector4d, 5>;  ///< inward planes about the eye

  void collect(const Camera& camera, const Frustum& frustum, double reach);
  void draw_collected() const;
  void draw_shadows(const Camera& camera, const Daylight& light);

  const Scene* scene_;
  Program depth_, picture_, sky_, shadow_;
  std::vector<Part> parts_;                       ///< one a surface
  std::vector<std::vector<Instance>> collected_;  ///< one a surface
  std::vector<Instance> upload_;
  std::uint32_t vertices_ = 0, indices_ = 0, instances_ = 0, array_ = 0, none_ = 0;
  std::uint32_t shadow_map_ = 0, shadow_framebuffer_ = 0;
  Eigen::Matrix4f shadow_matrix_ = Eigen::Matrix4f::Identity();
  std::size_t room_ = 0;  ///< instances that the buffer holds
};

}  // namespace muro::render
