// What a SceneFrame looks like: finger, contact, force, control nets and iterations, put into a Sketch.
#pragma once

#include "workbench/gui/render/scene_renderer.h"
#include "workbench/gui/render/sketch.h"

#include <vector>

namespace tangent {

struct SketchContext {
  const ContactScene& scene;
  NormalForm form;
  const SceneFrame& frame;
  const Camera& camera;
  int width_px, height_px;
  double force_metres_per_newton;
};

/// Typical length of gizmos, m: the finger's size, kept within the scene's and within the view's.
double gizmo_length_m(const SceneFrame& frame, const Camera& camera);

/// Length of the arrow of one newton: a 1-2-5 step, such that the present force is between a half and one and
/// a quarter gizmo length; `last` is kept while it still fits (no jumping), 0: none.
double choose_force_scale(const SceneFrame& frame, const Camera& camera, double last);

void draw_finger(Sketch& sketch, const SketchContext& c);
void draw_contact(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
void draw_force(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
void draw_iterations(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
void draw_control_nets(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
void draw_marked_triangles(Sketch& sketch, const SketchContext& c);
void draw_trail(Sketch& sketch, const SketchContext& c);

}  // namespace tangent
