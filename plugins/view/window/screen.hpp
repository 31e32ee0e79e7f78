// SPDX-License-Identifier: MIT
// A window of the window system with OpenGL, and what the user does in it (GLFW, Dear ImGui).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;

namespace muro::view {

/// Everything from one thread.
class Screen {
 public:
  /// Throws muro::Error where no window can be opened, with what to do. Its context is current then.
  Screen(const std::string& title, int width, int height);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  bool is_closed() const;
  /// Takes what the user did since the last frame and begins the next. Size in pixels.
  void begin();
  int width() const { return width_; }
  int height() const { return height_; }
  /// Draws what the panels have said over what is there, and shows it.
  void end();
  /// What the window shows, sRGB, rows from the top: to be asked between begin and end.
  std::vector<std::uint8_t> picture() const;

  /// While another context was current in this thread.
  void make_current() const;

 private:
  GLFWwindow* window_ = nullptr;
  int width_ = 0, height_ = 0;
};

}  // namespace muro::view
