// A GLFW window's events into its queue, and what has to be done the moment they come.
#pragma once

#include "workbench/gui/platform/glfw_window.h"
#include "workbench/gui/platform/input_queue.h"

#include <functional>
#include <string>
#include <vector>

namespace tangent {

class WindowInput {
 public:
  struct AtOnce {
    std::function<void(int key)> pressed = nullptr;  ///< before a frame gets to see it
    std::function<void()> drawn_is_lost = nullptr;
    std::function<void(std::vector<std::string> paths)> dropped = nullptr;
  };
  /// Takes the window's user pointer and callbacks; stays where it is. The window's ImGui context is current.
  WindowInput(GLFWwindow* window, AtOnce at_once);
  WindowInput(const WindowInput&) = delete;
  WindowInput& operator=(const WindowInput&) = delete;

  InputQueue& queue() { return queue_; }
  bool waiting() const { return queue_.waiting(); }

 private:
  static WindowInput& of(GLFWwindow* window) { return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window)); }
  void listen_to_keys(GLFWwindow* window);
  void listen_to_pointer(GLFWwindow* window);

  InputQueue queue_;
  AtOnce at_once_;
  ImGuiContext* context_;
};

}  // namespace tangent
