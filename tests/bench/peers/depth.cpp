// SPDX-License-Identifier: MIT
#include "tests/bench/peers/depth.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace muro::bench {

struct BareDepth::Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Context() {
    setenv("LP_NUM_THREADS", "0", 0);
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      const char* extensions = eglQueryDeviceStringEXT(devices[std::size_t(i)], EGL_EXTENSIONS);
      if (!extensions || !std::strstr(extensions, "EGL_MESA_device_software")) continue;
      display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[std::size_t(i)], nullptr);
    }
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
      throw std::runtime_error("EGL has no device by the processor");
    eglBindAPI(EGL_OPENGL_API);
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    make_current();
  }
  ~Context() { eglDestroyContext(display, context); }
  void make_current() const { eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context); }
};

namespace {

GLuint shader(GLenum kind, const char* source) {
  const GLuint s = glCreateShader(kind);
  glShaderSource(s, 1, &source, nullptr);
  glCompileShader(s);
  return s;
}

}  // namespace

BareDepth::BareDepth(std::uint32_t width, std::uint32_t height)
    : context_(std::make_unique<Context>()), width_(width), height_(height), depths_(std::size_t(width) * height) {
  program_ = glCreateProgram();
  glAttachShader(program_, shader(GL_VERTEX_SHADER, R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 row0;
layout(location = 2) in vec4 row1;
layout(location = 3) in vec4 row2;
layout(location = 0) uniform mat4 projection;
void main() {
  vec4 p = vec4(position, 1);
  gl_Position = projection * vec4(dot(row0, p), dot(row1, p), dot(row2, p), 1);
})"));
  glAttachShader(program_, shader(GL_FRAGMENT_SHADER, "#version 450 core\nvoid main() {}"));
  glLinkProgram(program_);
  std::array<float, 24> corners{};
  for (std::size_t k = 0; k < 24; ++k) corners[k] = (k / 3) >> (k % 3) & 1 ? 0.5F : -0.5F;
  constexpr std::uint8_t triangles[] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                        2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  glCreateBuffers(1, &cube_);
  glNamedBufferStorage(cube_, sizeof corners, corners.data(), 0);
  glCreateBuffers(1, &indices_);
  glNamedBufferStorage(indices_, sizeof triangles, triangles, 0);
  glCreateBuffers(1, &boxes_);
  glNamedBufferStorage(boxes_, 4096 * sizeof(Box), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glCreateVertexArrays(1, &array_);
  glVertexArrayElementBuffer(array_, indices_);
  glVertexArrayVertexBuffer(array_, 0, cube_, 0, 3 * sizeof(float));
  glVertexArrayVertexBuffer(array_, 1, boxes_, 0, sizeof(Box));
  glVertexArrayBindingDivisor(array_, 1, 1);
  for (GLuint k = 0; k < 4; ++k) {
    glEnableVertexArrayAttrib(array_, k);
    glVertexArrayAttribFormat(array_, k, k == 0 ? 3 : 4, GL_FLOAT, GL_FALSE, k == 0 ? 0 : 16 * (k - 1));
    glVertexArrayAttribBinding(array_, k, k == 0 ? 0 : 1);
  }
  glCreateRenderbuffers(1, &buffer_);
  glNamedRenderbufferStorage(buffer_, GL_DEPTH_COMPONENT32F, GLsizei(width), GLsizei(height));
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferRenderbuffer(framebuffer_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffer_);
  glNamedFramebufferDrawBuffer(framebuffer_, GL_NONE);
  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
}

BareDepth::~BareDepth() { context_->make_current(); }

void BareDepth::draw(const Eigen::Matrix4f& projection, std::span<const Box> boxes) {
  context_->make_current();
  glNamedBufferSubData(boxes_, 0, GLsizeiptr(boxes.size() * sizeof(Box)), boxes.data());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, GLsizei(width_), GLsizei(height_));
  const float far = 0;
  glClearBufferfv(GL_DEPTH, 0, &far);
  glUseProgram(program_);
  glUniformMatrix4fv(0, 1, GL_FALSE, projection.data());
  glBindVertexArray(array_);
  glDrawElementsInstanced(GL_TRIANGLES, 36, GL_UNSIGNED_BYTE, nullptr, GLsizei(boxes.size()));
  glReadPixels(0, 0, GLsizei(width_), GLsizei(height_), GL_DEPTH_COMPONENT, GL_FLOAT, depths_.data());
}

}  // namespace muro::bench
