#include "workbench/gui/platform/glfw_window.h"

#include "workbench/gui/platform/ui_drawing.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>

namespace tangent {

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

void hint_opengl() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SAMPLES, 0);  // the 3D view multisamples its own picture; ImGui smooths its edges itself
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
}

ImGuiOnWindow::ImGuiOnWindow(GLFWwindow* window) : window_(window), context_(ImGui::CreateContext()) {
  make_current();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window, false);  // events come through our queue
  ImGui_ImplOpenGL3_Init("#version 330 core");
  ImGui_ImplOpenGL3_CreateDeviceObjects();  // not in the first frame: that would put back how the atlas is read
}

ImGuiOnWindow::~ImGuiOnWindow() {
  make_current();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
}

void ImGuiOnWindow::make_current() const {
  glfwMakeContextCurrent(window_);
  ImGui::SetCurrentContext(context_);
}

WindowSize window_size(GLFWwindow* window) {
  int width = 0, height = 0;
  float scale_x = 1.0f, scale_y = 1.0f;
  WindowSize size;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &size.width_px, &size.height_px);
  glfwGetWindowContentScale(window, &scale_x, &scale_y);
  // Where window coordinates are not pixels, the system already does that part of the scaling.
  const float system_scale = width > 0 ? static_cast<float>(size.width_px) / static_cast<float>(width) : 1.0f;
  size.width = static_cast<float>(width);
  size.height = static_cast<float>(height);
  size.scale = std::max(scale_y / std::max(system_scale, 0.1f), 0.5f);
  return size;
}

void upload_fonts_again() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  use_nearest_pixels(font_texture());
}

}  // namespace tangent
