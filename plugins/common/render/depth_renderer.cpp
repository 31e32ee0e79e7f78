// SPDX-License-Identifier: MIT
#include "depth_renderer.hpp"

#include <epoxy/gl.h>

#include "shaders.hpp"

namespace muro::render {

DepthRenderer::DepthRenderer(Stage& stage)
    : stage_(&stage),
      distances_(shaders::place_vertex, shaders::depth_fragment),
      labels_(shaders::place_vertex, shaders::label_fragment) {}

void DepthRenderer::draw(const Camera& camera, const DepthTarget& target, std::uint32_t top) {
  stage_->collect(camera.pose.position, frustum_of(camera), camera.far, camera.ignored_robot);
  glViewport(0, GLint(top), GLsizei(camera.width), GLsizei(camera.height));
  (target.has_labels() ? labels_ : distances_).use();
  const Eigen::Matrix4f m = projection_of(camera).cast<float>();
  glUniformMatrix4fv(0, 1, GL_FALSE, m.data());
  stage_->draw();
}

}  // namespace muro::render
