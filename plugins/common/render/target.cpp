// SPDX-License-Identifier: MIT
#include "target.hpp"

#include <epoxy/gl.h>

#include <algorithm>

#include "gl_errors.hpp"
#include "muro/algorithm.hpp"

namespace muro::render {

namespace {

void check_framebuffer(GLuint framebuffer, std::uint32_t width, std::uint32_t height) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  if (width > std::uint32_t(most) || height > std::uint32_t(most))
    throw Error("a picture of " + std::to_string(width) + " by " + std::to_string(height) +
                " pixels is too large for OpenGL's device, which draws up to " + std::to_string(most) + " a side");
  check_gl("make a picture");
  if (glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error("the driver of OpenGL cannot draw into a picture of " + std::to_string(width) + " by " +
                std::to_string(height) + " pixels of this kind; try another size, or fewer `samples`");
}

/// Returns the most samples that a pixel of this format may have; 0 or 1: one.
GLint max_samples(GLenum format) {
  GLint largest = 0;  // the counts come in descending order
  glGetInternalformativ(GL_RENDERBUFFER, format, GL_SAMPLES, 1, &largest);
  return largest;
}

}  // namespace

ColorTarget::ColorTarget(std::uint32_t width, std::uint32_t height, std::uint32_t samples_per_pixel)
    : width_(width), height_(height) {
  const GLint most = std::min(max_samples(GL_SRGB8_ALPHA8), max_samples(GL_DEPTH_COMPONENT32F));
  samples_ = std::clamp(samples_per_pixel, 1U, std::uint32_t(std::max(most, 1)));
  const auto w = GLsizei(width), h = GLsizei(height), samples = GLsizei(samples_ > 1 ? samples_ : 0);
  glCreateRenderbuffers(3, buffers_);
  glNamedRenderbufferStorageMultisample(buffers_[0], samples, GL_SRGB8_ALPHA8, w, h);
  glNamedRenderbufferStorageMultisample(buffers_[1], samples, GL_DEPTH_COMPONENT32F, w, h);
  glNamedRenderbufferStorage(buffers_[2], GL_SRGB8_ALPHA8, w, h);
  glCreateFramebuffers(1, &drawn_);
  glNamedFramebufferRenderbuffer(drawn_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
  glNamedFramebufferRenderbuffer(drawn_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers_[1]);
  glCreateFramebuffers(1, &resolved_);
  glNamedFramebufferRenderbuffer(resolved_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[2]);
  check_framebuffer(drawn_, width, height);
  check_framebuffer(resolved_, width, height);
}

ColorTarget::~ColorTarget() {
  glDeleteFramebuffers(1, &drawn_);
  glDeleteFramebuffers(1, &resolved_);
  glDeleteRenderbuffers(3, buffers_);
}

void ColorTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
  glViewport(0, 0, GLsizei(width_), GLsizei(height_));
  glEnable(GL_FRAMEBUFFER_SRGB);
  const float black[] = {0, 0, 0, 1}, far = 0;
  glClearBufferfv(GL_COLOR, 0, black);
  glClearBufferfv(GL_DEPTH, 0, &far);
}

void ColorTarget::resolve() const {
  const auto w = GLint(width_), h = GLint(height_);
  glBlitNamedFramebuffer(drawn_, resolved_, 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void ColorTarget::read(std::span<std::uint8_t> rgb) const {
  resolve();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  const auto rows = GLsizei(rgb.size() / (std::size_t(3) * width_));
  glReadPixels(0, 0, GLsizei(width_), rows, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
  check_gl("draw a picture");
}

void ColorTarget::show() const {
  const auto w = GLint(width_), h = GLint(height_);
  resolve();
  glDisable(GL_FRAMEBUFFER_SRGB);  // the values are sRGB already
  glBlitNamedFramebuffer(resolved_, 0, 0, 0, w, h, 0, h, w, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

DepthTarget::DepthTarget(std::uint32_t width, std::uint32_t height, bool labels) : width_(width), height_(height) {
  const auto w = GLsizei(width), h = GLsizei(height);
  glCreateFramebuffers(1, &drawn_);
  glCreateRenderbuffers(labels ? 2 : 1, buffers_);
  glNamedRenderbufferStorage(buffers_[0], GL_DEPTH_COMPONENT32F, w, h);
  glNamedFramebufferRenderbuffer(drawn_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers_[0]);
  if (labels) {
    glNamedRenderbufferStorage(buffers_[1], GL_R32UI, w, h);
    glNamedFramebufferRenderbuffer(drawn_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[1]);
  } else {
    glNamedFramebufferDrawBuffer(drawn_, GL_NONE);
  }
  check_framebuffer(drawn_, width, height);
}

DepthTarget::~DepthTarget() {
  glDeleteFramebuffers(1, &drawn_);
  glDeleteRenderbuffers(has_labels() ? 2 : 1, buffers_);
}

void DepthTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
  glViewport(0, 0, GLsizei(width_), GLsizei(height_));
  glDisable(GL_FRAMEBUFFER_SRGB);
  const GLuint no_label[] = {0xffffffff, 0, 0, 0};
  const float far = 0;
  if (has_labels()) glClearBufferuiv(GL_COLOR, 0, no_label);
  glClearBufferfv(GL_DEPTH, 0, &far);
}

void DepthTarget::read(std::span<float> inverse) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
  const auto rows = GLsizei(inverse.size() / width_);
  glReadPixels(0, 0, GLsizei(width_), rows, GL_DEPTH_COMPONENT, GL_FLOAT, inverse.data());
  check_gl("draw a depth picture");
}

void DepthTarget::read(std::span<std::uint32_t> labels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
  const auto rows = GLsizei(labels.size() / width_);
  glReadPixels(0, 0, GLsizei(width_), rows, GL_RED_INTEGER, GL_UNSIGNED_INT, labels.data());
  check_gl("draw a picture of labels");
}

}  // namespace muro::render
