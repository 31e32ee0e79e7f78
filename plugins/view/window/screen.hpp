// SPDX-License-Identifier: MIT
// A window of the window system with OpenGL, and the input of its user (GLFW, Dear ImGui).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;

namespace muro::view {

enum class Key { space, right, escape, home };

/// A window. One thread calls all of its functions.
class Screen {
 public:
  /// Throws muro::Error when no window can be opened; the message says what to do.
  Screen(const std::string& title, int width, int height);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  bool is_closed() const;
  /// Whether the display has gone: nothing can be drawn any more.
  bool is_lost() const;
  /// Takes the input since the last frame and the size in pixels, and begins the next frame. Begins none when the
  /// display is lost, which may happen here.
  void begin();
  /// Keys that were pressed since the last frame, even if they were released at once.
  const std::vector<Key>& keys() const { return keys_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Draws the panels over the scene, and shows the frame. `picture`, if given, receives the image of the window: sRGB,
  /// rows from the top.
  void end(std::vector<std::uint8_t>* picture = nullptr);

  /// Whether the processor draws instead of a GPU.
  bool is_software() const;
  /// Keeps the window's context current in this thread while it lives; then no context is current. Cameras and lasers
  /// have contexts of their own by EGL, which refuses them while a window's context is current.
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
