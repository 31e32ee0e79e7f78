// SPDX-License-Identifier: MIT
#include "context.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "muro/algorithm.hpp"

namespace muro::render {

struct Context::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

struct Current::Previous {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface draw = EGL_NO_SURFACE, read = EGL_NO_SURFACE;
  EGLDisplay own = EGL_NO_DISPLAY;
};

namespace {

bool has(const char* extensions, const char* wanted) {
  return extensions != nullptr && std::strstr(extensions, wanted) != nullptr;
}

struct Candidate {
  EGLDeviceEXT device = EGL_NO_DEVICE_EXT;
  bool software = false;
};

/// Returns all devices, GPUs first.
std::vector<Candidate> candidates() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!has(client, "EGL_EXT_device_enumeration") && !has(client, "EGL_EXT_device_base")) return {};
  std::array<EGLDeviceEXT, 32> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count)) return {};
  std::vector<Candidate> found;
  for (const bool software : {false, true})
    for (EGLint i = 0; i < count; ++i) {
      const bool is = has(eglQueryDeviceStringEXT(devices[std::size_t(i)], EGL_EXTENSIONS), "EGL_MESA_device_software");
      if (is == software) found.push_back({devices[std::size_t(i)], software});
    }
  return found;
}

}  // namespace

Context::Context(Device device) : handles_(std::make_unique<Handles>()) {
  // llvmpipe's own threads cost more than they save in pictures of sensors, and muro has threads of its own.
  if (device != Device::gpu) setenv("LP_NUM_THREADS", "0", 0);
  std::string tried;
  for (const Candidate& c : candidates()) {
    if (device != Device::any && c.software != (device == Device::software)) continue;
    const std::string name = c.software ? "the processor" : "a GPU";
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, c.device, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
      tried += "; " + name + " cannot be initialised";
      continue;
    }
    eglBindAPI(EGL_OPENGL_API);
    constexpr EGLint wanted[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (context == EGL_NO_CONTEXT) {
      tried += "; " + name + " has no OpenGL 4.5";
      continue;
    }
    *handles_ = {display, context};
    software_ = c.software;
    const Current current(*this);
    renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return;
  }
  throw Error("nothing here draws by OpenGL 4.5" + (tried.empty() ? "; EGL knows no such device" : tried) +
              ". Install libegl1 and libgl1-mesa-dri, with which the processor draws, or the driver of a GPU with EGL; "
              "`device` says which is taken");
}

Context::~Context() {
  if (handles_->context != EGL_NO_CONTEXT) eglDestroyContext(handles_->display, handles_->context);
}

Current::Current(const Context& context) : previous_(std::make_unique<Previous>()) {
  eglBindAPI(EGL_OPENGL_API);
  *previous_ = {eglGetCurrentDisplay(), eglGetCurrentContext(), eglGetCurrentSurface(EGL_DRAW),
                eglGetCurrentSurface(EGL_READ), context.handles_->display};
  if (!eglMakeCurrent(context.handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context.handles_->context))
    throw Error("OpenGL's context cannot be used in this thread: EGL error " + std::to_string(eglGetError()));
}

Current::~Current() {
  if (previous_->context != EGL_NO_CONTEXT)
    eglMakeCurrent(previous_->display, previous_->draw, previous_->read, previous_->context);
  else
    eglMakeCurrent(previous_->own, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace muro::render
