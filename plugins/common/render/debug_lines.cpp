// SPDX-License-Identifier: MIT
#include "debug_lines.hpp"

#include <epoxy/gl.h>

#include <cstddef>
#include <tuple>

#include "gpu_scene.hpp"
#include "shaders.hpp"

namespace muro::render {

namespace {

/// A point in the form of the vertex shader: relative to the camera.
struct PointData {
  std::array<float, 3> position;
  std::array<float, 4> color;
};

}  // namespace

DebugLines::DebugLines() : program_(shaders::line_vertex, shaders::line_fragment) {
  glCreateBuffers(1, &vertex_buffer_);
  glCreateVertexArrays(1, &vertex_array_);
  glVertexArrayVertexBuffer(vertex_array_, 0, vertex_buffer_, 0, sizeof(PointData));
  for (const auto& [location, count, offset] :
       {std::tuple{0U, 3, offsetof(PointData, position)}, std::tuple{1U, 4, offsetof(PointData, color)}}) {
    glEnableVertexArrayAttrib(vertex_array_, location);
    glVertexArrayAttribFormat(vertex_array_, location, count, GL_FLOAT, GL_FALSE, GLuint(offset));
    glVertexArrayAttribBinding(vertex_array_, location, 0);
  }
}

DebugLines::~DebugLines() {
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteBuffers(1, &vertex_buffer_);
}

void DebugLines::clear() {
  lines_.clear();
  points_.clear();
}

void DebugLines::add_line(const Vec3& from, const Vec3& to, const Vec3& color, double alpha) {
  const std::array<float, 4> c{float(color.x()), float(color.y()), float(color.z()), float(alpha)};
  lines_.push_back({from, c});
  lines_.push_back({to, c});
}

void DebugLines::add_point(const Vec3& at, const Vec3& color) {
  points_.push_back({at, {float(color.x()), float(color.y()), float(color.z()), 1}});
}

void DebugLines::draw(const Camera& camera, const std::vector<ColoredPoint>& ends, std::uint32_t primitive) const {
  if (ends.empty()) return;
  std::vector<PointData> vertices;
  vertices.reserve(ends.size());
  for (const ColoredPoint& p : ends) {
    const Vec3 at = p.position - camera.pose.position;
    vertices.push_back({{float(at.x()), float(at.y()), float(at.z())}, p.color});
  }
  glNamedBufferData(vertex_buffer_, GLsizeiptr(vertices.size() * sizeof(PointData)), vertices.data(), GL_STREAM_DRAW);
  glDrawArrays(primitive, 0, GLsizei(vertices.size()));
}

void DebugLines::draw(const Camera& camera) const {
  program_.use();
  const Eigen::Matrix4f m = projection_of(camera).cast<float>();
  glUniformMatrix4fv(0, 1, GL_FALSE, m.data());
  glBindVertexArray(vertex_array_);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glPointSize(4);
  draw(camera, lines_, GL_LINES);
  draw(camera, points_, GL_POINTS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace muro::render
