// The view of a 2D scene, in place of the 3D view: polygon, smooth curve and patches, local centres, the tangent lines
// of the tick's iterations, the finger with its contact, the force.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/widgets/ui_context.h"

namespace tangent {

struct PlanarView {
  bool patches = true, polygon = true, curve = true, centres = false, tangents = true, finger = true, force = true,
       display = true;
  Vec2 centre{0.0};       ///< middle of the view, world, m
  double px_per_m = 0.0;  ///< 0: to be framed
  float top = 0.0f;       ///< height of the toggles along the upper edge, points; of the last frame
  const ContactScene* framed = nullptr;
  std::uint64_t framings = 0;  ///< framings of the model (F) followed so far
};

/// Inside the 3D view's window. Precondition: the model's scene is planar.
void draw_planar_view(const UiContext& ui, AppModel& model, PlanarView& view, const Rect& rect);

}  // namespace tangent
