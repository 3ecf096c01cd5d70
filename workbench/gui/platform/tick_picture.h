// One tick as a picture of the scene: finger, contact, force and tangent planes, seen from beside the contact. Without
// a display.
#pragma once

#include "workbench/gui/render/image.h"
#include "workbench/gui/render/staged_scene.h"

namespace tangent {

struct TickPictureRequest {
  std::shared_ptr<const ContactScene> scene;  ///< 3D
  Preset preset;
  TickRecord tick;  ///< `kept`: the state before it; it is solved again for its planes
  Theme theme = Theme::light;
  int width_px = 760, height_px = 570;
  double scale = 1.6;  ///< of text and lines
};

/// Fails without off-screen GL.
Result<Image> tick_picture(const TickPictureRequest& request);

}  // namespace tangent
