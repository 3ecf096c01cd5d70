// GLFW, its windows, and ImGui on each of them.
#pragma once

// Not OpenGL: whoever draws has epoxy for it.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <memory>
#include <string>

namespace tangent {

/// What GLFW says of the last failure.
std::string glfw_reason();

/// RAII: initialises and terminates GLFW.
class GlfwLibrary {
 public:
  GlfwLibrary() : ready_(glfwInit() == GLFW_TRUE) {}
  ~GlfwLibrary() {
    if (ready_) glfwTerminate();
  }
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
  bool ready() const { return ready_; }

 private:
  bool ready_;
};

struct WindowCloser {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, WindowCloser>;

/// OpenGL 3.3 core, for the windows opened next.
void hint_opengl();

/// RAII: an ImGui context with both back ends, current from here on. The window's GL context is current, too.
class ImGuiOnWindow {
 public:
  explicit ImGuiOnWindow(GLFWwindow* window);
  ~ImGuiOnWindow();
  ImGuiOnWindow(const ImGuiOnWindow&) = delete;
  ImGuiOnWindow& operator=(const ImGuiOnWindow&) = delete;
  void make_current() const;

 private:
  GLFWwindow* window_;
  ImGuiContext* context_;
};

/// A window's size in ImGui's coordinates, and what its monitor asks its contents to be scaled by.
struct WindowSize {
  float width = 0.0f, height = 0.0f, scale = 1.0f;
  int width_px = 0, height_px = 0;
};
WindowSize window_size(GLFWwindow* window);

/// The atlas of the current context was rebuilt.
void upload_fonts_again();

}  // namespace tangent
