// SPDX-License-Identifier: MIT
#include "screen.hpp"

#include <epoxy/gl.h>
// must come after epoxy, which replaces the headers of OpenGL
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <string_view>
#include <utility>

#include "muro/algorithm.hpp"

// Function of GLFW for X11; null when GLFW was built without X11.
extern "C" __attribute__((weak)) void* glfwGetX11Display();

namespace muro::view {

namespace {

bool is_open = false;  ///< GLFW and ImGui allow this program one thread and one window
std::atomic<bool> display_lost{false};

/// Keeps Xlib from ending the process when the display of the window goes away. Losses of other displays of the program
/// go to the previous handler.
class DisplayLoss {
 public:
  using Handler = int (*)(void* display);
  using ExitHandler = void (*)(void* display, void* data);

  void begin() {
    display_lost = false;
    display_ = glfwGetX11Display ? glfwGetX11Display() : nullptr;
    library_ = display_ ? dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD) : nullptr;
    if (!library_) return;
    set_ = reinterpret_cast<Handler (*)(Handler)>(dlsym(library_, "XSetIOErrorHandler"));
    const auto set_exit =
        reinterpret_cast<void (*)(void*, ExitHandler, void*)>(dlsym(library_, "XSetIOErrorExitHandler"));
    if (!set_ || !set_exit) return;  // this Xlib always ends the process
    set_exit(
        display_, [](void*, void*) { display_lost = true; }, nullptr);
    before_ = set_(&take);
  }
  void end() {
    if (before_ && set_) set_(before_);
    before_ = nullptr;
    if (library_) dlclose(library_);
    library_ = nullptr;
  }

 private:
  static int take(void* display) {
    if (display != display_) return before_(display);
    display_lost = true;
    return 0;
  }

  void* library_ = nullptr;
  Handler (*set_)(Handler) = nullptr;
  static void* display_;
  static Handler before_;
};
void* DisplayLoss::display_ = nullptr;
DisplayLoss::Handler DisplayLoss::before_ = nullptr;
DisplayLoss display_loss;

[[noreturn]] void fail(const std::string& what) {
  const char* words = nullptr;
  glfwGetError(&words);
  throw Error(
      what + (words ? std::string(": ") + words : std::string()) +
      ". Run it where there is a display with OpenGL 4.5 (DISPLAY or WAYLAND_DISPLAY is set), under `xvfb-run -a` "
      "without one, or take pictures with `muro render`");
}

}  // namespace

Screen::Screen(const std::string& title, int width, int height) {
  if (is_open) throw Error("a program has one window; remove all algorithms view.window but one");
  glfwSetErrorCallback(nullptr);
  if (!glfwInit()) fail("there is no display to open a window on");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    glfwTerminate();
    fail("no window with OpenGL 4.5 can be opened");
  }
  display_loss.begin();
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0);  // waiting for the screen would slow the simulation down
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 4;
  style.Colors[ImGuiCol_WindowBg].w = 0.85F;
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, &Screen::on_key);  // set before the callback of ImGui, which calls this one
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 450");
  glfwMakeContextCurrent(nullptr);
  is_open = true;
}

Screen::~Screen() {
  is_open = false;
  glfwMakeContextCurrent(window_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
  display_loss.end();
}

bool Screen::is_lost() const { return display_lost; }

bool Screen::is_closed() const { return glfwWindowShouldClose(window_) != 0; }

bool Screen::is_software() const {
  const std::string_view renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return renderer.find("llvmpipe") != std::string_view::npos || renderer.find("softpipe") != std::string_view::npos;
}

Screen::Current::Current(const Screen& screen) { glfwMakeContextCurrent(screen.window_); }
Screen::Current::~Current() { glfwMakeContextCurrent(nullptr); }

void Screen::on_key(GLFWwindow* window, int key, int, int action, int) {
  constexpr std::pair<int, Key> known[] = {{GLFW_KEY_SPACE, Key::space},
                                           {GLFW_KEY_RIGHT, Key::right},
                                           {GLFW_KEY_ESCAPE, Key::escape},
                                           {GLFW_KEY_HOME, Key::home}};
  auto& screen = *static_cast<Screen*>(glfwGetWindowUserPointer(window));
  for (const auto& [code, meaning] : known)
    if (code == key && action == GLFW_PRESS) screen.pending_keys_.push_back(meaning);
}

void Screen::begin() {
  if (frame_begun_) ImGui::EndFrame();  // the last frame could not be drawn
  frame_begun_ = false;
  glfwPollEvents();
  if (display_lost) return;
  keys_.clear();
  keys_.swap(pending_keys_);
  glfwGetFramebufferSize(window_, &width_, &height_);
  width_ = std::max(width_, 1);
  height_ = std::max(height_, 1);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  frame_begun_ = true;
}

void Screen::end(std::vector<std::uint8_t>* picture) {
  ImGui::Render();
  frame_begun_ = false;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  if (picture) *picture = read();
  glfwSwapBuffers(window_);
}

std::vector<std::uint8_t> Screen::read() const {
  std::vector<std::uint8_t> upside_down(std::size_t(3) * std::size_t(width_) * std::size_t(height_)),
      rows(upside_down.size());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  const std::size_t row = std::size_t(3) * std::size_t(width_);
  for (std::size_t k = 0; k < std::size_t(height_); ++k)
    std::copy_n(upside_down.begin() + std::ptrdiff_t((std::size_t(height_) - 1 - k) * row), row,
                rows.begin() + std::ptrdiff_t(k * row));
  return rows;
}

}  // namespace muro::view
