// SPDX-License-Identifier: MIT
#include "stage.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "image.hpp"

namespace muro::render {

namespace {

GLuint texture_of(const Image& image) {
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
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = axes_of(c);
  return p * turn;
}

Frustum frustum_of(const Camera& c) {
  const Eigen::Matrix4d m = projection_of(c);
  Frustum planes;
  for (int k = 0; k < 4; ++k) planes[std::size_t(k)] = m.row(3) + (k % 2 == 0 ? 1 : -1) * m.row(k / 2);
  planes[4] = m.row(3);
  for (Eigen::Vector4d& plane : planes) plane /= plane.head<3>().norm();
  return planes;
}

Stage::Stage(const Scene& scene) : scene_(&scene), placed_(scene.pieces().size()), collected_(scene.surfaces().size()) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  pictures_.push_back(texture_of(Image::white()));
  for (const Image& image : scene.pictures()) pictures_.push_back(texture_of(image));
  for (const Surface& s : scene.surfaces()) {
    parts_.push_back({std::uint32_t(indices.size()), std::uint32_t(s.indices.size()), std::int32_t(vertices.size()),
                      pictures_[std::size_t(s.picture + 1)]});
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
  attribute(8, 0, 2, offsetof(Vertex, picture));

  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  make_groups();
}

Stage::~Stage() {
  glDeleteVertexArrays(1, &array_);
  for (const GLuint buffer : {vertices_, indices_, instances_}) glDeleteBuffers(1, &buffer);
  glDeleteTextures(GLsizei(pictures_.size()), pictures_.data());
}

void Stage::make_groups() {
  const std::vector<Piece>& pieces = scene_->pieces();
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const bool goes_on = !groups_.empty() && pieces[i].robot >= 0 && groups_.back().robot == pieces[i].robot;
    if (goes_on)
      ++groups_.back().count;
    else
      groups_.push_back({i, 1, pieces[i].robot});
  }
  const auto robot = [](const Group& g) { return g.robot >= 0; };
  moving_ = std::size_t(std::find_if(groups_.begin(), groups_.end(), robot) - groups_.begin());
}

void Stage::enclose(Group& g) const {
  g.middle = placed_[g.first].at;
  g.radius = 0;
  for (std::uint32_t i = g.first; i < g.first + g.count; ++i)
    g.radius = std::max(g.radius, (placed_[i].at - g.middle).norm() + scene_->pieces()[i].radius);
}

void Stage::place() {
  for (std::size_t k = is_placed_ ? moving_ : 0; k < groups_.size(); ++k) {
    Group& g = groups_[k];
    for (std::uint32_t i = g.first; i < g.first + g.count; ++i) {
      const Piece& p = scene_->pieces()[i];
      const Pose pose = p.pose();
      placed_[i] = {pose.position, pose.orientation.toRotationMatrix() * p.scale.asDiagonal()};
    }
    enclose(g);
  }
  is_placed_ = true;
}

void Stage::add(const Vec3& eye, std::uint32_t piece, double reach) {
  const Piece& p = scene_->pieces()[piece];
  Mat3 turn = placed_[piece].turn;
  Vec3 at = placed_[piece].at - eye;
  if (p.endless) {  // as far as one sees, from below the eye
    const Vec3 normal = turn.col(2);
    at = normal * normal.dot(at);
    turn.leftCols<2>() *= 2 * reach;
  }
  Instance& i = collected_[p.surface].emplace_back();
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) i.place[std::size_t(4 * row + k)] = float(turn(row, k));
    i.place[std::size_t(4 * row + 3)] = float(at[row]);
    i.color[std::size_t(row)] = float(p.color[row]);
  }
  i.label = std::uint32_t(p.object);
  i.pattern = p.endless ? 1 : 0;
}

void Stage::collect(const Vec3& eye, const Frustum& frustum, double reach, std::int32_t ignored_robot) {
  for (auto& list : collected_) list.clear();
  const auto is_seen = [&](const Vec3& middle, double radius) {
    const Vec3 at = middle - eye;
    if (at.squaredNorm() > (reach + radius) * (reach + radius)) return false;
    for (const Eigen::Vector4d& plane : frustum)
      if (plane[0] * at.x() + plane[1] * at.y() + plane[2] * at.z() + plane[3] <= -radius) return false;
    return true;
  };
  for (const Group& g : groups_) {
    if (g.robot >= 0 && g.robot == ignored_robot) continue;
    const bool endless = scene_->pieces()[g.first].endless;
    if (!endless && !is_seen(g.middle, g.radius)) continue;
    for (std::uint32_t i = g.first; i < g.first + g.count; ++i)
      if (g.count == 1 || is_seen(placed_[i].at, scene_->pieces()[i].radius)) add(eye, i, reach);
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

void Stage::draw() const {
  glBindVertexArray(array_);
  GLuint first = 0;
  for (std::size_t s = 0; s < parts_.size(); ++s) {
    const auto count = GLsizei(collected_[s].size());
    if (count == 0) continue;
    const Part& p = parts_[s];
    glBindTextureUnit(1, p.picture);
    glDrawElementsInstancedBaseVertexBaseInstance(
        GL_TRIANGLES, GLsizei(p.indices), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(std::size_t(p.first_index) * sizeof(std::uint32_t)), count, p.first_vertex,
        first);
    first += GLuint(count);
  }
}

}  // namespace muro::render
