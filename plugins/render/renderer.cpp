// SPDX-License-Identifier: MIT
#include "renderer.hpp"

#include <epoxy/gl.h>

#include <cstddef>

#include "shaders.hpp"

namespace muro::render {

namespace {

constexpr float horizon[] = {0.62F, 0.70F, 0.78F};
constexpr int shadow_pixels = 2048;

enum Uniform : GLint { to_picture = 0, to_sun = 1, to_shadow = 2, shadow_size = 3, eye = 4, horizon_color = 5 };

/// Rows: right, up, forward.
Mat3 axes_of(const Camera& c) {
  const Mat3 r = c.pose.orientation.toRotationMatrix();
  Mat3 axes;
  axes << -r.col(1).transpose(), r.col(2).transpose(), r.col(0).transpose();
  return axes;
}

/// From places about the eye to what the rasteriser wants. Depth is near / distance, from 1 down to 0 at infinity: so
/// single precision is spread evenly over distances.
Eigen::Matrix4d projection_of(const Camera& c) {
  Eigen::Matrix4d p = Eigen::Matrix4d::Zero();  // from right, up, forward
  p(0, 0) = 2 * c.fx / c.width;
  p(0, 2) = 2 * c.cx / c.width - 1;
  p(1, 1) = 2 * c.fy / c.height;
  p(1, 2) = 1 - 2 * c.cy / c.height;
  p(2, 3) = c.near;
  p(3, 2) = 1;
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = axes_of(c);
  return p * turn;
}

/// The four sides of a picture, and what lies ahead.
std::array<Eigen::Vector4d, 5> frustum_of(const Camera& c) {
  const Eigen::Matrix4d m = projection_of(c);
  std::array<Eigen::Vector4d, 5> planes;
  for (int k = 0; k < 4; ++k) planes[std::size_t(k)] = m.row(3) + (k % 2 == 0 ? 1 : -1) * m.row(k / 2);
  planes[4] = m.row(3);
  for (Eigen::Vector4d& plane : planes) plane /= plane.head<3>().norm();
  return planes;
}

void set(Uniform where, const Eigen::Matrix4f& m) { glUniformMatrix4fv(where, 1, GL_FALSE, m.data()); }

}  // namespace

Renderer::Renderer(const Scene& scene)
    : scene_(&scene),
      depth_(shaders::place_vertex, shaders::label_fragment),
      picture_(shaders::place_vertex, shaders::picture_fragment),
      sky_(shaders::sky_vertex, shaders::sky_fragment),
      shadow_(shaders::place_vertex, shaders::shadow_fragment),
      collected_(scene.surfaces().size()) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const Surface& s : scene.surfaces()) {
    parts_.push_back({std::uint32_t(indices.size()), std::uint32_t(s.indices.size()), std::int32_t(vertices.size())});
    vertices.insert(vertices.end(), s.vertices.begin(), s.vertices.end());
    indices.insert(indices.end(), s.indices.begin(), s.indices.end());
  }
  glCreateBuffers(1, &vertices_);
  glCreateBuffers(1, &indices_);
  glCreateBuffers(1, &instances_);
  if (!vertices.empty()) {
    glNamedBufferStorage(vertices_, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
    glNamedBufferStorage(indices_, GLsizeiptr(indices.size() * sizeof(std::uint32_t)), indices.data(), 0);
  }
  glCreateVertexArrays(1, &none_);
  glCreateVertexArrays(1, &array_);
  glVertexArrayElementBuffer(array_, indices_);
  glVertexArrayVertexBuffer(array_, 0, vertices_, 0, sizeof(Vertex));
  glVertexArrayBindingDivisor(array_, 1, 1);
  const auto attribute = [&](GLuint place, GLuint binding, GLint count, std::size_t offset) {
    glEnableVertexArrayAttrib(array_, place);
    glVertexArrayAttribFormat(array_, place, count, GL_FLOAT, GL_FALSE, GLuint(offset));
    glVertexArrayAttribBinding(array_, place, binding);
  };
  attribute(0, 0, 3, offsetof(Vertex, position));
  attribute(1, 0, 3, offsetof(Vertex, normal));
  for (GLuint row = 0; row < 3; ++row) attribute(2 + row, 1, 4, offsetof(Instance, place) + 16 * row);
  attribute(5, 1, 3, offsetof(Instance, color));
  glEnableVertexArrayAttrib(array_, 6);
  glVertexArrayAttribIFormat(array_, 6, 1, GL_UNSIGNED_INT, offsetof(Instance, label));
  glVertexArrayAttribBinding(array_, 6, 1);
  attribute(7, 1, 1, offsetof(Instance, pattern));

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

  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
}

Renderer::~Renderer() {
  glDeleteFramebuffers(1, &shadow_framebuffer_);
  glDeleteTextures(1, &shadow_map_);
  for (const GLuint array : {array_, none_}) glDeleteVertexArrays(1, &array);
  for (const GLuint buffer : {vertices_, indices_, instances_}) glDeleteBuffers(1, &buffer);
}

/// What is inside of the planes and nearer than `reach` (m), about the camera's eye.
void Renderer::collect(const Camera& camera, const Frustum& frustum, double reach) {
  for (auto& list : collected_) list.clear();
  const Vec3 eye_at = camera.pose.position;
  for (const Piece& p : scene_->pieces()) {
    if (p.robot >= 0 && p.robot == camera.ignored_robot) continue;
    Pose pose = p.pose();
    Vec3 scale = p.scale, at = pose.position - eye_at;
    if (p.endless) {  // as far as one sees, from below the eye
      const Vec3 normal = pose.orientation * Vec3::UnitZ();
      at = normal * normal.dot(at);
      scale = Vec3(2 * reach, 2 * reach, 1);
    } else {
      if (at.squaredNorm() > (reach + p.radius) * (reach + p.radius)) continue;
      bool inside = true;
      for (const Eigen::Vector4d& plane : frustum) inside = inside && plane.head<3>().dot(at) + plane[3] > -p.radius;
      if (!inside) continue;
    }
    const Mat3 turn = pose.orientation.toRotationMatrix() * scale.asDiagonal();
    Instance& i = collected_[p.surface].emplace_back();
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 3; ++k) i.place[std::size_t(4 * row + k)] = float(turn(row, k));
      i.place[std::size_t(4 * row + 3)] = float(at[row]);
      i.color[std::size_t(row)] = float(p.color[row]);
    }
    i.label = std::uint32_t(p.object);
    i.pattern = p.endless ? 1 : 0;
  }
  upload_.clear();
  for (const auto& list : collected_) upload_.insert(upload_.end(), list.begin(), list.end());
  if (upload_.size() > room_) {
    room_ = 2 * upload_.size();
    glNamedBufferData(instances_, GLsizeiptr(room_ * sizeof(Instance)), nullptr, GL_STREAM_DRAW);
    glVertexArrayVertexBuffer(array_, 1, instances_, 0, sizeof(Instance));
  }
  if (!upload_.empty())
    glNamedBufferSubData(instances_, 0, GLsizeiptr(upload_.size() * sizeof(Instance)), upload_.data());
}

void Renderer::draw_collected() const {
  glBindVertexArray(array_);
  GLuint first = 0;
  for (std::size_t s = 0; s < parts_.size(); ++s) {
    const auto count = GLsizei(collected_[s].size());
    if (count == 0) continue;
    const Part& p = parts_[s];
    glDrawElementsInstancedBaseVertexBaseInstance(
        GL_TRIANGLES, GLsizei(p.indices), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(std::size_t(p.first_index) * sizeof(std::uint32_t)), count, p.first_vertex,
        first);
    first += GLuint(count);
  }
}

void Renderer::draw(const Camera& camera, const DepthTarget& target) {
  collect(camera, frustum_of(camera), camera.far);
  target.begin();
  depth_.use();
  set(to_picture, projection_of(camera).cast<float>());
  draw_collected();
}

/// The sun sees everything along parallel lines; near the camera, so that the map is fine there.
void Renderer::draw_shadows(const Camera& camera, const Daylight& light) {
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
  collect(camera, around, 1e4);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_);
  glViewport(0, 0, shadow_pixels, shadow_pixels);
  const float far = 0;
  glClearBufferfv(GL_DEPTH, 0, &far);
  shadow_.use();
  set(to_picture, shadow_matrix_);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1.5F, -4);
  draw_collected();
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void Renderer::draw(const Camera& camera, const ColorTarget& target, const Daylight& light) {
  if (light.shadows) draw_shadows(camera, light);
  collect(camera, frustum_of(camera), camera.far);
  target.begin();

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
  draw_collected();
}

}  // namespace muro::render
