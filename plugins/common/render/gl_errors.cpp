// SPDX-License-Identifier: MIT
#include "gl_errors.hpp"

#include <epoxy/gl.h>

#include <cstdio>
#include <string>

#include "muro/algorithm.hpp"

namespace muro::render {

namespace {

std::string text_of(GLenum error) {
  switch (error) {
    case GL_OUT_OF_MEMORY:
      return "its device has no memory left; make pictures, meshes or textures smaller, or have `device: software`";
    case GL_CONTEXT_LOST:
      return "its device was reset; try `device: software`";
    default:
      break;
  }
  char number[32];
  std::snprintf(number, sizeof number, "0x%04X", error);
  return "the driver reports error " + std::string(number) + "; try another one, or `device: software`";
}

}  // namespace

void check_gl(const char* doing) {
  const GLenum first = glGetError();
  if (first == GL_NO_ERROR) return;
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {  // a lost context reports errors without end
  }
  throw Error("OpenGL failed to " + std::string(doing) + ": " + text_of(first));
}

}  // namespace muro::render
