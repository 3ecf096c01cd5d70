#include "workbench/gui/render/sketch_layer.h"

namespace tangent {
namespace {

constexpr float kTowardEye = 8e-4f;      // depth offset, as a fraction of the distance to the eye
constexpr float kBehindOpacity = 0.25f;  // of hidden strokes

}  // namespace

void SketchLayer::draw(const ScenePrograms& programs, const Sketch& sketch, const Camera& camera, int width_px,
                       int height_px, float pixel_scale) {
  const ViewMatrices view(camera, sketch.origin(), sketch.scale_m(), width_px, height_px);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_solids(programs, sketch, view, true);

  glDepthMask(GL_FALSE);
  fills_.upload(sketch.fills());
  programs.fills.use();
  view.apply(programs.fills);
  programs.fills.set("toward_eye", 0.5f * kTowardEye);
  programs.fills.set("opacity", 1.0f);
  fills_.draw();

  strokes_.upload(sketch.strokes(), GL_STREAM_DRAW);
  programs.strokes.use();
  view.apply(programs.strokes);
  programs.strokes.set("toward_eye", kTowardEye);
  programs.strokes.set("width_scale", pixel_scale);
  programs.strokes.set("opacity", kBehindOpacity);
  glDepthFunc(GL_GREATER);
  strokes_.draw();
  programs.strokes.set("opacity", 1.0f);
  glDepthFunc(GL_LEQUAL);
  strokes_.draw();

  draw_solids(programs, sketch, view, false);
  glDepthMask(GL_TRUE);
}

void SketchLayer::draw_solids(const ScenePrograms& programs, const Sketch& sketch, const ViewMatrices& view,
                              bool opaque) const {
  programs.solid.use();
  view.apply(programs.solid);
  glEnable(GL_CULL_FACE);
  for (const Solid& solid : sketch.solids()) {
    if ((solid.colour.a >= 1.0f) != opaque) continue;
    programs.solid.set("model_view", view.model_view * solid.place);
    programs.solid.set("semi_axes", solid.semi_axes);
    programs.solid.set("half_length", solid.half_length);
    programs.solid.set("albedo", rgba(solid.colour));
    programs.solid.set("rim_opacity", solid.rim_opacity);
    solids_.draw(solid.shape);
  }
  glDisable(GL_CULL_FACE);
}

}  // namespace tangent
