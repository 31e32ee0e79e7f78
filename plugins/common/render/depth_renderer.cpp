// SPDX-License-Identifier: MIT
#include "depth_renderer.hpp"

#include <epoxy/gl.h>

#include "shaders.hpp"

namespace muro::render {

DepthRenderer::DepthRenderer(GpuScene& scene)
    : scene_(&scene),
      depths_(shaders::instance_vertex, shaders::depth_fragment),
      labels_(shaders::instance_vertex, shaders::label_fragment) {}

void DepthRenderer::draw(const Camera& camera, const DepthTarget& target, std::uint32_t top) {
  scene_->cull(camera.pose.position, frustum_of(camera), camera.far, camera.ignored_robot);
  glViewport(0, GLint(top), GLsizei(camera.width), GLsizei(camera.height));
  (target.has_labels() ? labels_ : depths_).use();
  const Eigen::Matrix4f m = projection_of(camera).cast<float>();
  glUniformMatrix4fv(0, 1, GL_FALSE, m.data());
  scene_->draw();
}

}  // namespace muro::render
