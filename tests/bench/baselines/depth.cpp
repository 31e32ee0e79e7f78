// SPDX-License-Identifier: MIT
#include "tests/bench/baselines/depth.hpp"

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
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
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

BareDepth::BareDepth(std::uint32_t width, std::uint32_t height, const render::Surface& cylinder)
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
  std::vector<float> corners;
  std::vector<std::uint32_t> indices;
  const auto add = [&](const render::Surface& surface) {
    for (const render::Vertex& v : surface.vertices)
      corners.insert(corners.end(), v.position.begin(), v.position.end());
    indices.insert(indices.end(), surface.indices.begin(), surface.indices.end());
  };
  add(render::unit_box());
  box_indices_ = std::uint32_t(indices.size());
  box_corners_ = std::uint32_t(corners.size() / 3);
  add(cylinder);
  cylinder_indices_ = std::uint32_t(cylinder.indices.size());
  glCreateBuffers(1, &corners_);
  glNamedBufferStorage(corners_, GLsizeiptr(corners.size() * sizeof(float)), corners.data(), 0);
  glCreateBuffers(1, &indices_);
  glNamedBufferStorage(indices_, GLsizeiptr(indices.size() * sizeof(std::uint32_t)), indices.data(), 0);
  glCreateBuffers(1, &transforms_);
  glNamedBufferStorage(transforms_, 4096 * sizeof(Transform), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glCreateVertexArrays(1, &array_);
  glVertexArrayElementBuffer(array_, indices_);
  glVertexArrayVertexBuffer(array_, 0, corners_, 0, 3 * sizeof(float));
  glVertexArrayVertexBuffer(array_, 1, transforms_, 0, sizeof(Transform));
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

void BareDepth::draw(const Eigen::Matrix4f& projection, const Instances& instances) {
  context_->make_current();
  const auto boxes = GLsizei(instances.boxes.size()), cylinders = GLsizei(instances.cylinders.size());
  const auto size = GLsizeiptr(sizeof(Transform));
  glNamedBufferSubData(transforms_, 0, boxes * size, instances.boxes.data());
  glNamedBufferSubData(transforms_, boxes * size, cylinders * size, instances.cylinders.data());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, GLsizei(width_), GLsizei(height_));
  const float far = 0;
  glClearBufferfv(GL_DEPTH, 0, &far);
  glUseProgram(program_);
  glUniformMatrix4fv(0, 1, GL_FALSE, projection.data());
  glBindVertexArray(array_);
  glDrawElementsInstanced(GL_TRIANGLES, GLsizei(box_indices_), GL_UNSIGNED_INT, nullptr, boxes);
  glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, GLsizei(cylinder_indices_), GL_UNSIGNED_INT,
                                                reinterpret_cast<const void*>(box_indices_ * sizeof(std::uint32_t)),
                                                cylinders, GLint(box_corners_), GLuint(boxes));
  glReadPixels(0, 0, GLsizei(width_), GLsizei(height_), GL_DEPTH_COMPONENT, GL_FLOAT, depths_.data());
}

}  // namespace muro::bench
