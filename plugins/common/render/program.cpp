// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <epoxy/gl.h>

#include "muro/algorithm.hpp"

namespace muro::render {

namespace {

GLuint compiled(GLenum kind, const std::string& text) {
  const GLuint shader = glCreateShader(kind);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::string log(4096, '\0');
  glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
  throw Error("the driver of OpenGL does not compile a shader: " + std::string(log.c_str()));
}

}  // namespace

Program::Program(const std::string& vertex, const std::string& fragment) : id_(glCreateProgram()) {
  const GLuint shaders[] = {compiled(GL_VERTEX_SHADER, vertex), compiled(GL_FRAGMENT_SHADER, fragment)};
  for (const GLuint s : shaders) glAttachShader(id_, s);
  glLinkProgram(id_);
  for (const GLuint s : shaders) glDeleteShader(s);
  GLint good = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &good);
  if (good) return;
  std::string log(4096, '\0');
  glGetProgramInfoLog(id_, GLsizei(log.size()), nullptr, log.data());
  throw Error("the driver of OpenGL does not link a program: " + std::string(log.c_str()));
}

Program::~Program() { glDeleteProgram(id_); }

void Program::use() const { glUseProgram(id_); }

}  // namespace muro::render
