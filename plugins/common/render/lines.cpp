// SPDX-License-Identifier: MIT
#include "lines.hpp"

#include <epoxy/gl.h>

#include <cstddef>
#include <tuple>

#include "shaders.hpp"
#include "stage.hpp"

namespace muro::render {

namespace {

/// As the vertex shader gets it: about the eye.
struct Drawn {
  std::array<float, 3> at;
  std::array<float, 4> color;
};

}  // namespace

Lines::Lines() : program_(shaders::line_vertex, shaders::line_fragment) {
  glCreateBuffers(1, &buffer_);
  glCreateVertexArrays(1, &array_);
  glVertexArrayVertexBuffer(array_, 0, buffer_, 0, sizeof(Drawn));
  for (const auto& [place, count, offset] :
       {std::tuple{0U, 3, offsetof(Drawn, at)}, std::tuple{1U, 4, offsetof(Drawn, color)}}) {
    glEnableVertexArrayAttrib(array_, place);
    glVertexArrayAttribFormat(array_, place, count, GL_FLOAT, GL_FALSE, GLuint(offset));
    glVertexArrayAttribBinding(array_, place, 0);
  }
}

Lines::~Lines() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &buffer_);
}

void Lines::clear() {
  lines_.clear();
  points_.clear();
}

void Lines::add(const Vec3& from, const Vec3& to, const Vec3& color, double cover) {
  const std::array<float, 4> c{float(color.x()), float(color.y()), float(color.z()), float(cover)};
  lines_.push_back({from, c});
  lines_.push_back({to, c});
}

void Lines::point(const Vec3& at, const Vec3& color) {
  points_.push_back({at, {float(color.x()), float(color.y()), float(color.z()), 1}});
}

void Lines::draw(const Camera& camera, const std::vector<End>& ends, std::uint32_t kind) const {
  if (ends.empty()) return;
  std::vector<Drawn> vertices;
  vertices.reserve(ends.size());
  for (const End& e : ends) {
    const Vec3 at = e.at - camera.pose.position;
    vertices.push_back({{float(at.x()), float(at.y()), float(at.z())}, e.color});
  }
  glNamedBufferData(buffer_, GLsizeiptr(vertices.size() * sizeof(Drawn)), vertices.data(), GL_STREAM_DRAW);
  glDrawArrays(kind, 0, GLsizei(vertices.size()));
}

void Lines::draw(const Camera& camera) const {
  program_.use();
  const Eigen::Matrix4f m = projection_of(camera).cast<float>();
  glUniformMatrix4fv(0, 1, GL_FALSE, m.data());
  glBindVertexArray(array_);
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
