// The object and the finger as a picture, for practice and training. Nothing is written on it.
#pragma once

#include "workbench/gui/experiment/participant_screen.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/session/session.h"

#include <imgui.h>

#include <cstdint>
#include <memory>

namespace tangent {

class PracticeScene {
 public:
  PracticeScene();
  /// As SceneRenderer::init. A GL context is current, here, in draw and at the end.
  Status init();
  /// The session's scene and newest tick, for a screen of this size. Empty: there is nothing to draw.
  PracticePicture draw(const Session& session, ImVec2 screen, Theme theme);
  std::uint64_t version() const { return renderer_->picture_version(); }
  /// Until the surface is drawn as finely as it will be: for pictures.
  void wait() { renderer_->wait_for_tessellation(); }

 private:
  void frame_scene(const Session& session, double aspect);
  std::unique_ptr<SceneRenderer> renderer_;
  std::shared_ptr<const ContactScene> scene_;
  Camera camera_;
};

}  // namespace tangent
