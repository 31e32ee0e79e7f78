// SPDX-License-Identifier: MIT
// A window of the window system with OpenGL, and what the user does in it (GLFW, Dear ImGui).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;

namespace muro::view {

enum class Key { space, right, escape, home };

/// Everything from one thread.
class Screen {
 public:
  /// Throws muro::Error where no window can be opened, with what to do.
  Screen(const std::string& title, int width, int height);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  bool is_closed() const;
  /// Whether the display has gone: nothing can be drawn any more.
  bool is_lost() const;
  /// Takes what the user did since the last frame and begins the next. Size in pixels. Not when the display is lost,
  /// which may happen here.
  void begin();
  /// Keys that were pressed since the frame before, however shortly.
  const std::vector<Key>& keys() const { return keys_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Draws the panels over the scene, and shows the frame. `picture`, if given, receives the image of the window: sRGB,
  /// rows from the top.
  void end(std::vector<std::uint8_t>* picture = nullptr);

  /// Whether the processor draws.
  bool is_software() const;
  /// While it lives, the window's context is current in this thread; then none is: cameras and lasers have contexts of
  /// their own, by EGL, which is refused where one of a window is current.
  class Current {
   public:
    explicit Current(const Screen& screen);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
  };

 private:
  std::vector<std::uint8_t> read() const;

  static void on_key(GLFWwindow* window, int key, int code, int action, int modifiers);

  GLFWwindow* window_ = nullptr;
  std::vector<Key> keys_, pending_keys_;
  int width_ = 0, height_ = 0;
  bool frame_begun_ = false;
};

}  // namespace muro::view
