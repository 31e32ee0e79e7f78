// SPDX-License-Identifier: MIT
#include "picture_renderer.hpp"

#include <epoxy/gl.h>

#include "shaders.hpp"

namespace muro::render {

namespace {

constexpr float horizon[] = {0.62F, 0.70F, 0.78F};
constexpr int shadow_pixels = 2048;

enum Uniform : GLint { to_picture = 0, to_sun = 1, to_shadow = 2, shadow_size = 3, eye = 4, horizon_color = 5 };

void set(Uniform where, const Eigen::Matrix4f& m) { glUniformMatrix4fv(where, 1, GL_FALSE, m.data()); }

}  // namespace

PictureRenderer::PictureRenderer(Stage& stage)
    : stage_(&stage),
      picture_(shaders::place_vertex, shaders::picture_fragment),
      sky_(shaders::sky_vertex, shaders::sky_fragment),
      shadow_(shaders::place_vertex, shaders::depth_fragment) {
  glCreateVertexArrays(1, &none_);
  glCreateTextures(GL_TEXTURE_2D, 1, &shadow_map_);
  glTextureStorage2D(shadow_map_, 1, GL_DEPTH_COMPONENT32F, shadow_pixels, shadow_pixels);
  glTextureParameteri(shadow_map_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(shadow_map_, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  for (const GLenum way : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTextureParameteri(shadow_map_, way, GL_LINEAR);
  for (const GLenum way : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTextureParameteri(shadow_map_, way, GL_CLAMP_TO_EDGE);
  glCreateFramebuffers(1, &shadow_framebuffer_);
  glNamedFramebufferTexture(shadow_framebuffer_, GL_DEPTH_ATTACHMENT, shadow_map_, 0);
  glNamedFramebufferDrawBuffer(shadow_framebuffer_, GL_NONE);
}

PictureRenderer::~PictureRenderer() {
  glDeleteFramebuffers(1, &shadow_framebuffer_);
  glDeleteTextures(1, &shadow_map_);
  glDeleteVertexArrays(1, &none_);
}

/// The sun sees everything along parallel lines; near the camera, so that the map is fine there.
void PictureRenderer::draw_shadows(const Camera& camera, const Daylight& light) {
  const Vec3 forward = camera.pose.orientation * Vec3::UnitX(), towards = light.to_sun;
  const Vec3 right = Vec3(-towards.y(), towards.x(), 0).normalized(), up = towards.cross(right);
  const double range = light.shadow_range, depth = 4 * range;
  const Vec3 middle = 0.8 * range * forward;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.block<1, 3>(0, 0) = right.transpose() / range;
  m.block<1, 3>(1, 0) = up.transpose() / range;
  m.block<1, 3>(2, 0) = towards.transpose() / (2 * depth);
  m.block<3, 1>(0, 3) = -m.topLeftCorner<3, 3>() * middle;
  m(2, 3) += 0.5;
  shadow_matrix_ = m.cast<float>();

  Frustum around;  // the box of the map, open to the sun
  const Vec3 sides[] = {right, -right, up, -up};
  for (std::size_t k = 0; k < 4; ++k) around[k] << sides[k], range - sides[k].dot(middle);
  around[4] << towards, depth - towards.dot(middle);
  stage_->collect(camera.pose.position, around, 1e4, camera.ignored_robot);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_);
  glViewport(0, 0, shadow_pixels, shadow_pixels);
  const float far = 0;
  glClearBufferfv(GL_DEPTH, 0, &far);
  shadow_.use();
  set(to_picture, shadow_matrix_);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1.5F, -4);
  stage_->draw();
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void PictureRenderer::draw_sky(const Camera& camera) const {
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(none_);
  sky_.use();
  Eigen::Matrix4d from = Eigen::Matrix4d::Zero();  // right, up, forward of a place in the picture
  from(0, 0) = camera.width / (2 * camera.fx);
  from(0, 3) = (0.5 * camera.width - camera.cx) / camera.fx;
  from(1, 1) = camera.height / (2 * camera.fy);
  from(1, 3) = (camera.cy - 0.5 * camera.height) / camera.fy;
  from(2, 3) = 1;
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = axes_of(camera).transpose();
  set(to_picture, (turn * from).cast<float>());
  glUniform3fv(horizon_color, 1, horizon);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

void PictureRenderer::draw(const Camera& camera, const ColorTarget& target, const Daylight& light) {
  if (light.shadows) draw_shadows(camera, light);
  stage_->collect(camera.pose.position, frustum_of(camera), camera.far, camera.ignored_robot);
  target.begin();
  draw_sky(camera);
  picture_.use();
  set(to_picture, projection_of(camera).cast<float>());
  const Eigen::Vector3f sun = light.to_sun.cast<float>();
  glUniform3fv(to_sun, 1, sun.data());
  glUniform3fv(horizon_color, 1, horizon);
  glUniform1f(shadow_size, light.shadows ? shadow_pixels : 0);
  glUniform2f(eye, float(std::fmod(camera.pose.position.x(), 2)), float(std::fmod(camera.pose.position.y(), 2)));
  if (light.shadows) {
    set(to_shadow, shadow_matrix_);
    glBindTextureUnit(0, shadow_map_);
  }
  stage_->draw();
}

}  // namespace muro::render
