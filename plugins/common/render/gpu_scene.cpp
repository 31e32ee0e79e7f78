// SPDX-License-Identifier: MIT
#include "gpu_scene.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "gl_errors.hpp"
#include "image.hpp"

namespace muro::render {

namespace {

GLuint upload_texture(const Image& image) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  const auto w = GLsizei(image.width), h = GLsizei(image.height);
  GLsizei levels = 1;
  while ((std::max(w, h) >> levels) > 0) ++levels;
  glTextureStorage2D(name, levels, GL_SRGB8_ALPHA8, w, h);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(name, 0, 0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  glGenerateTextureMipmap(name);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return name;
}

}  // namespace

Eigen::Matrix4d projection_of(const Camera& c) {
  Eigen::Matrix4d p = Eigen::Matrix4d::Zero();  // from right, up, forward
  p(0, 0) = 2 * c.fx / c.width;
  p(0, 2) = 2 * c.cx / c.width - 1;
  p(1, 1) = 2 * c.fy / c.height;
  p(1, 2) = 1 - 2 * c.cy / c.height;
  p(2, 3) = c.near;
  p(3, 2) = 1;
  Eigen::Matrix4d rotation = Eigen::Matrix4d::Identity();
  rotation.topLeftCorner<3, 3>() = axes_of(c);
  return p * rotation;
}

Frustum frustum_of(const Camera& c) {
  const Eigen::Matrix4d m = projection_of(c);
  Frustum planes;
  for (int k = 0; k < 4; ++k) planes[std::size_t(k)] = m.row(3) + (k % 2 == 0 ? 1 : -1) * m.row(k / 2);
  planes[4] = m.row(3);
  for (Eigen::Vector4d& plane : planes) plane /= plane.head<3>().norm();
  return planes;
}

GpuScene::GpuScene(const Scene& scene)
    : scene_(&scene), transforms_(scene.instances().size()), selected_(scene.surfaces().size()) {
  upload_surfaces();
  describe_attributes();
  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  make_groups();
  check_gl("take the scene over");
}

void GpuScene::upload_surfaces() {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  textures_.push_back(upload_texture(Image::white()));
  for (const Image& image : scene_->textures()) textures_.push_back(upload_texture(image));
  glCreateSamplers(1, &edge_sampler_);
  glSamplerParameteri(edge_sampler_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(edge_sampler_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum direction : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glSamplerParameteri(edge_sampler_, direction, GL_CLAMP_TO_EDGE);
  for (const Surface& s : scene_->surfaces()) {
    surfaces_.push_back({std::uint32_t(indices.size()), std::uint32_t(s.indices.size()), std::int32_t(vertices.size()),
                         textures_[std::size_t(s.texture + 1)], s.repeats ? 0 : edge_sampler_});
    vertices.insert(vertices.end(), s.vertices.begin(), s.vertices.end());
    indices.insert(indices.end(), s.indices.begin(), s.indices.end());
  }
  glCreateBuffers(1, &vertex_buffer_);
  glCreateBuffers(1, &index_buffer_);
  glCreateBuffers(1, &instance_buffer_);
  if (vertices.empty()) return;
  glNamedBufferStorage(vertex_buffer_, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
  glNamedBufferStorage(index_buffer_, GLsizeiptr(indices.size() * sizeof(std::uint32_t)), indices.data(), 0);
}

/// Describes where the vertex shader finds its inputs.
void GpuScene::describe_attributes() {
  glCreateVertexArrays(1, &vertex_array_);
  glVertexArrayElementBuffer(vertex_array_, index_buffer_);
  glVertexArrayVertexBuffer(vertex_array_, 0, vertex_buffer_, 0, sizeof(Vertex));
  glVertexArrayBindingDivisor(vertex_array_, 1, 1);
  const auto attribute = [&](GLuint location, GLuint binding, GLint count, std::size_t offset) {
    glEnableVertexArrayAttrib(vertex_array_, location);
    glVertexArrayAttribFormat(vertex_array_, location, count, GL_FLOAT, GL_FALSE, GLuint(offset));
    glVertexArrayAttribBinding(vertex_array_, location, binding);
  };
  attribute(0, 0, 3, offsetof(Vertex, position));
  attribute(1, 0, 3, offsetof(Vertex, normal));
  for (GLuint row = 0; row < 3; ++row) attribute(2 + row, 1, 4, offsetof(InstanceData, transform) + 16 * row);
  attribute(5, 1, 3, offsetof(InstanceData, color));
  glEnableVertexArrayAttrib(vertex_array_, 6);
  glVertexArrayAttribIFormat(vertex_array_, 6, 1, GL_UNSIGNED_INT, offsetof(InstanceData, label));
  glVertexArrayAttribBinding(vertex_array_, 6, 1);
  attribute(7, 1, 1, offsetof(InstanceData, in_metres));
  attribute(8, 0, 2, offsetof(Vertex, texture_coordinates));
}

GpuScene::~GpuScene() {
  glDeleteVertexArrays(1, &vertex_array_);
  for (const GLuint buffer : {vertex_buffer_, index_buffer_, instance_buffer_}) glDeleteBuffers(1, &buffer);
  glDeleteTextures(GLsizei(textures_.size()), textures_.data());
  glDeleteSamplers(1, &edge_sampler_);
}

void GpuScene::make_groups() {
  const std::vector<Instance>& instances = scene_->instances();
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    const RobotId robot = instances[i].body.robot;
    if (!groups_.empty() && robot != no_robot && groups_.back().robot == robot)
      ++groups_.back().count;
    else
      groups_.push_back({i, 1, robot});
  }
  const auto is_robot = [](const Group& g) { return g.robot != no_robot; };
  first_robot_ = std::size_t(std::find_if(groups_.begin(), groups_.end(), is_robot) - groups_.begin());
}

void GpuScene::enclose(Group& g) const {
  g.centre = transforms_[g.first].position;
  g.radius = 0;
  for (std::uint32_t i = g.first; i < g.first + g.count; ++i)
    g.radius = std::max(g.radius, (transforms_[i].position - g.centre).norm() + scene_->instances()[i].radius);
}

void GpuScene::update() {
  for (std::size_t k = is_scenery_placed_ ? first_robot_ : 0; k < groups_.size(); ++k) {
    Group& g = groups_[k];
    for (std::uint32_t i = g.first; i < g.first + g.count; ++i) {
      const Instance& instance = scene_->instances()[i];
      const Pose pose = instance.pose();
      transforms_[i] = {pose.position, pose.orientation.toRotationMatrix() * instance.scale.asDiagonal()};
    }
    enclose(g);
  }
  is_scenery_placed_ = true;
}

void GpuScene::add(const Vec3& eye, std::uint32_t number, double range) {
  const Instance& instance = scene_->instances()[number];
  Mat3 matrix = transforms_[number].matrix;
  Vec3 position = transforms_[number].position - eye;
  if (instance.is_infinite) {  // up to the range, around the foot of the perpendicular from the eye
    const Vec3 normal = matrix.col(2);
    position = normal * normal.dot(position);
    matrix.leftCols<2>() *= 2 * range;
  }
  InstanceData& data = selected_[instance.surface].emplace_back();
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) data.transform[std::size_t(4 * row + k)] = float(matrix(row, k));
    data.transform[std::size_t(4 * row + 3)] = float(position[row]);
    data.color[std::size_t(row)] = float(instance.color[row]);
  }
  data.label = std::uint32_t(instance.body.object);
  data.in_metres = instance.is_infinite ? 1 : 0;
}

void GpuScene::cull(const Vec3& eye, const Frustum& frustum, double range, RobotId ignored_robot) {
  for (auto& list : selected_) list.clear();
  const auto is_visible = [&](const Vec3& centre, double radius) {
    const Vec3 at = centre - eye;
    if (at.squaredNorm() > (range + radius) * (range + radius)) return false;
    for (const Eigen::Vector4d& plane : frustum)
      if (plane[0] * at.x() + plane[1] * at.y() + plane[2] * at.z() + plane[3] <= -radius) return false;
    return true;
  };
  for (const Group& g : groups_) {
    if (g.robot != no_robot && g.robot == ignored_robot) continue;
    const bool is_infinite = scene_->instances()[g.first].is_infinite;
    if (!is_infinite && !is_visible(g.centre, g.radius)) continue;
    for (std::uint32_t i = g.first; i < g.first + g.count; ++i)
      if (g.count == 1 || is_visible(transforms_[i].position, scene_->instances()[i].radius)) add(eye, i, range);
  }
  upload_.clear();
  for (const auto& list : selected_) upload_.insert(upload_.end(), list.begin(), list.end());
  if (upload_.size() > capacity_) {
    capacity_ = 2 * upload_.size();
    glNamedBufferData(instance_buffer_, GLsizeiptr(capacity_ * sizeof(InstanceData)), nullptr, GL_STREAM_DRAW);
    glVertexArrayVertexBuffer(vertex_array_, 1, instance_buffer_, 0, sizeof(InstanceData));
  }
  if (!upload_.empty())
    glNamedBufferSubData(instance_buffer_, 0, GLsizeiptr(upload_.size() * sizeof(InstanceData)), upload_.data());
}

void GpuScene::draw() const {
  glBindVertexArray(vertex_array_);
  GLuint first = 0;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    const auto count = GLsizei(selected_[s].size());
    if (count == 0) continue;
    const SurfaceRange& surface = surfaces_[s];
    glBindTextureUnit(1, surface.texture);
    glBindSampler(1, surface.sampler);
    glDrawElementsInstancedBaseVertexBaseInstance(
        GL_TRIANGLES, GLsizei(surface.indices), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(std::size_t(surface.first_index) * sizeof(std::uint32_t)), count,
        surface.first_vertex, first);
    first += GLuint(count);
  }
  glBindSampler(1, 0);
}

}  // namespace muro::render
