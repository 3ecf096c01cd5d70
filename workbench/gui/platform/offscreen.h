// Draws the window's frames off screen: a surfaceless GL context (EGL), an ImGui context and a framebuffer object. For
// `workbench shot`, tests and machines without a display.
#pragma once

#include "core/base/result.h"
#include "workbench/gui/render/image.h"

#include <imgui.h>

#include <functional>
#include <memory>

namespace tangent {

/// A current GL 3.3 core context without a display, one per thread. Fails when EGL or the driver does not support it.
class OffscreenContext {
 public:
  static Result<OffscreenContext> open();
  OffscreenContext(OffscreenContext&& other) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) = delete;
  ~OffscreenContext();

 private:
  OffscreenContext(void* display, void* context) : display_(display), context_(context) {}
  void* display_ = nullptr;
  void* context_ = nullptr;
};

/// Context, ImGui and framebuffer together. An App must be created after open() and destroyed before this.
class OffscreenScreen {
 public:
  static Result<std::unique_ptr<OffscreenScreen>> open(int width_px, int height_px);
  ~OffscreenScreen();
  OffscreenScreen(const OffscreenScreen&) = delete;
  OffscreenScreen& operator=(const OffscreenScreen&) = delete;

  /// Call after the font atlas was rebuilt.
  void upload_fonts();
  /// One frame. `build` runs where the window's does: after the back end's NewFrame; it writes injected
  /// input, calls ImGui::NewFrame and ImGui::Render. What it drew is then on the screen, and what the driver kept for
  /// it is given back.
  /// What `build` leaves open is `ground`.
  void frame(const std::function<void()>& build, const ImVec4& ground = {0.0f, 0.0f, 0.0f, 1.0f});
  /// A frame that nobody looks at: panels and plots follow, nothing is drawn.
  void unseen_frame(const std::function<void()>& build);
  Image picture() const;

 private:
  struct Impl;
  explicit OffscreenScreen(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
