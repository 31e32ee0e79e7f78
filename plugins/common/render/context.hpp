// SPDX-License-Identifier: MIT
// OpenGL without a window and without a display server: EGL on a device (EGL_EXT_platform_device).
#pragma once

#include <memory>
#include <string>

namespace muro::render {

/// The device that renders.
enum class Device {
  any,       ///< the first GPU that can, else the processor
  gpu,       ///< the first GPU that can
  software,  ///< the processor, by Mesa's llvmpipe, in the calling thread
};

/// An OpenGL 4.5 core context. It is current in one thread at a time, while a Current of it lives there.
class Context {
 public:
  /// Throws muro::Error if no device offers a context, with what was tried and what to install. [setup]
  explicit Context(Device device);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Returns the name that the driver reports.
  const std::string& renderer() const { return renderer_; }
  bool is_software() const { return software_; }

 private:
  friend class Current;
  struct Handles;
  std::unique_ptr<Handles> handles_;
  std::string renderer_;
  bool software_ = false;
};

/// Makes a context current in this thread during its lifetime, and the previous one current again afterwards.
class Current {
 public:
  explicit Current(const Context& context);
  ~Current();
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  struct Previous;
  std::unique_ptr<Previous> previous_;
};

}  // namespace muro::render
