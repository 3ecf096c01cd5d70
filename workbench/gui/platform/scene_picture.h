// The 3D view and what is written over it, drawn off-screen.
#pragma once

#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/render/scene_renderer.h"

namespace tangent {

struct PictureSize {
  int width_px = 0, height_px = 0;
  double scale = 1.0;  ///< of text and lines
};

/// All over the screen, which has this size. screen.picture() is it.
void draw_scene_picture(OffscreenScreen& screen, SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                        const PictureSize& size);

}  // namespace tangent
