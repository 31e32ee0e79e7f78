// SPDX-License-Identifier: MIT
#include "color_renderer.hpp"

#include <epoxy/gl.h>

#include "shaders.hpp"

namespace muro::render {

namespace {

constexpr float horizon[] = {0.62F, 0.70F, 0.78F};
constexpr int shadow_pixels = 2048;

enum Uniform : GLint { to_clip = 0, to_sun = 1, to_shadow = 2, shadow_size = 3, eye = 4, horizon_color = 5 };

void set(Uniform where, const Eigen::Matrix4f& m) { glUniformMatrix4fv(where, 1, GL_FALSE, m.data()); }

std::string color_fragment(std::string_view kind) {
  std::string text{kind};
  return text.append(std::string_view(shaders::color_fragment));
}

}  // namespace

ColorRenderer::ColorRenderer(GpuScene& scene)
    : scene_(&scene),
      shadowed_color_(shaders::instance_vertex, color_fragment(shaders::with_shadows)),
      plain_color_(shaders::instance_vertex, color_fragment(shaders::without_shadows)),
      sky_(shaders::sky_vertex, shaders::sky_fragment),
      shadow_(shaders::instance_vertex, shaders::depth_fragment) {
  glCreateVertexArrays(1, &empty_array_);
  glCreateTextures(GL_TEXTURE_2D, 1, &shadow_map_);
  glTextureStorage2D(shadow_map_, 1, GL_DEPTH_COMPONENT32F, shadow_pixels, shadow_pixels);
  glTextureParameteri(shadow_map_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(shadow_map_, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  for (const GLenum parameter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTextureParameteri(shadow_map_, parameter, GL_LINEAR);
  for (const GLenum parameter : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTextureParameteri(shadow_map_, parameter, GL_CLAMP_TO_EDGE);
  glCreateFramebuffers(1, &shadow_framebuffer_);
  glNamedFramebufferTexture(shadow_framebuffer_, GL_DEPTH_ATTACHMENT, shadow_map_, 0);
  glNamedFramebufferDrawBuffer(shadow_framebuffer_, GL_NONE);
}

ColorRenderer::~ColorRenderer() {
  glDeleteFramebuffers(1, &shadow_framebuffer_);
  glDeleteTextures(1, &shadow_map_);
  glDeleteVertexArrays(1, &empty_array_);
}

/// Draws a parallel projection along the sunlight of what is near the camera, so that the map is fine there.
void ColorRenderer::draw_shadows(const Camera& camera, const Daylight& light) {
  const Vec3 forward = camera.pose.orientation * Vec3::UnitX(), towards = light.to_sun;
  const Vec3 right = Vec3(-towards.y(), towards.x(), 0).normalized(), up = towards.cross(right);
  const double range = light.shadow_range, depth = 4 * range;
  const Vec3 centre = 0.8 * range * forward;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.block<1, 3>(0, 0) = right.transpose() / range;
  m.block<1, 3>(1, 0) = up.transpose() / range;
  m.block<1, 3>(2, 0) = towards.transpose() / (2 * depth);
  m.block<3, 1>(0, 3) = -m.topLeftCorner<3, 3>() * centre;
  m(2, 3) += 0.5;
  shadow_matrix_ = m.cast<float>();

  Frustum around;  // the box of the map, open to the sun
  const Vec3 sides[] = {right, -right, up, -up};
  for (std::size_t k = 0; k < 4; ++k) around[k] << sides[k], range - sides[k].dot(centre);
  around[4] << towards, depth - towards.dot(centre);
  scene_->cull(camera.pose.position, around, 1e4, camera.ignored_robot);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_);
  glViewport(0, 0, shadow_pixels, shadow_pixels);
  const float far = 0;
  glClearBufferfv(GL_DEPTH, 0, &far);
  shadow_.use();
  set(to_clip, shadow_matrix_);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1.5F, -4);
  scene_->draw();
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ColorRenderer::draw_sky(const Camera& camera) const {
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(empty_array_);
  sky_.use();
  Eigen::Matrix4d from = Eigen::Matrix4d::Zero();  // from clip space to right, up, forward
  from(0, 0) = camera.width / (2 * camera.fx);
  from(0, 3) = (0.5 * camera.width - camera.cx) / camera.fx;
  from(1, 1) = camera.height / (2 * camera.fy);
  from(1, 3) = (camera.cy - 0.5 * camera.height) / camera.fy;
  from(2, 3) = 1;
  Eigen::Matrix4d rotation = Eigen::Matrix4d::Identity();
  rotation.topLeftCorner<3, 3>() = axes_of(camera).transpose();
  set(to_clip, (rotation * from).cast<float>());
  glUniform3fv(horizon_color, 1, horizon);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

void ColorRenderer::draw(const Camera& camera, const ColorTarget& target, const Daylight& light) {
  if (light.shadows) draw_shadows(camera, light);
  scene_->cull(camera.pose.position, frustum_of(camera), camera.far, camera.ignored_robot);
  target.begin();
  draw_sky(camera);
  (light.shadows ? shadowed_color_ : plain_color_).use();
  set(to_clip, projection_of(camera).cast<float>());
  const Eigen::Vector3f sun = light.to_sun.cast<float>();
  glUniform3fv(to_sun, 1, sun.data());
  glUniform3fv(horizon_color, 1, horizon);
  glUniform2f(eye, float(std::fmod(camera.pose.position.x(), 2)), float(std::fmod(camera.pose.position.y(), 2)));
  if (light.shadows) {
    glUniform1f(shadow_size, shadow_pixels);
    set(to_shadow, shadow_matrix_);
    glBindTextureUnit(0, shadow_map_);
  }
  scene_->draw();
}

}  // namespace muro::render
