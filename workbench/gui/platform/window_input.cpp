#include "workbench/gui/platform/window_input.h"

#include <utility>

namespace tangent {

WindowInput::WindowInput(GLFWwindow* window, AtOnce at_once)
    : at_once_(std::move(at_once)), context_(ImGui::GetCurrentContext()) {
  glfwSetWindowUserPointer(window, this);
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    if (const auto& dropped = of(w).at_once_.dropped) dropped({paths, paths + count});
  });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) {
    if (const auto& lost = of(w).at_once_.drawn_is_lost) lost();
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    ImGuiContext* const before = ImGui::GetCurrentContext();
    ImGui::SetCurrentContext(of(w).context_);
    ImGui::GetIO().AddFocusEvent(focused == GLFW_TRUE);
    ImGui::SetCurrentContext(before);
  });
  listen_to_keys(window);
  listen_to_pointer(window);
}

void WindowInput::listen_to_keys(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    WindowInput& self = of(w);
    if (action == GLFW_PRESS && self.at_once_.pressed) self.at_once_.pressed(key);
    if (action != GLFW_REPEAT) self.queue_.key(key, action == GLFW_PRESS);  // ImGui repeats by itself
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int code_point) { of(w).queue_.character(code_point); });
}

void WindowInput::listen_to_pointer(GLFWwindow* window) {
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* w, int button, int action, int) { of(w).queue_.button(button, action == GLFW_PRESS); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    of(w).queue_.position(static_cast<float>(x), static_cast<float>(y));
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    if (entered == GLFW_FALSE) of(w).queue_.pointer_left();
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    of(w).queue_.wheel(static_cast<float>(x), static_cast<float>(y));
  });
  if (glfwGetWindowAttrib(window, GLFW_HOVERED) == GLFW_TRUE) {  // its position before it first moves
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window, &x, &y);
    queue_.position(static_cast<float>(x), static_cast<float>(y));
  }
}

}  // namespace tangent
