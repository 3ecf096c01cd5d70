// Converts a SceneFrame into a Sketch: finger, contact, force, control nets and iterations.
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

/// Typical length of gizmos, m: the finger's size, limited by those of scene and view.
double gizmo_length_m(const SceneFrame& frame, const Camera& camera);

/// Arrow length of one newton, m: a 1-2-5 step such that the current force is drawn 0.5 to 1.25 gizmo lengths long.
/// `last` (0: none) is kept while it still fits, so that the scale does not jump.
double choose_force_scale(const SceneFrame& frame, const Camera& camera, double last);

void draw_finger(Sketch& sketch, const SketchContext& c);
void draw_contact(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
/// An arrow for the computed force, and one for the felt force where that is another; each with its number and name.
void draw_force(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
void draw_iterations(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
void draw_beside_iterations(Sketch& sketch, const SketchContext& c);
void draw_control_nets(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels);
void draw_marked_triangles(Sketch& sketch, const SketchContext& c);
void draw_trail(Sketch& sketch, const SketchContext& c);

}  // namespace tangent
