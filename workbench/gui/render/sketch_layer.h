// Draws a Sketch over a finished mesh layer: fills, strokes (also, faintly, where a surface hides them)
// and lit solids, the transparent ones last.
#pragma once

#include "workbench/gui/render/scene_buffers.h"
#include "workbench/gui/render/scene_programs.h"
#include "workbench/gui/render/sketch.h"

namespace tangent {

class SketchLayer {
 public:
  void create() { solids_.create(); }
  /// Into the bound framebuffer, whose depth holds the mesh.
  void draw(const ScenePrograms& programs, const Sketch& sketch, const Camera& camera, int width_px, int height_px,
            float pixel_scale);

 private:
  void draw_solids(const ScenePrograms& programs, const Sketch& sketch, const ViewMatrices& view, bool opaque) const;

  StrokeBuffer strokes_;
  FillBuffer fills_;
  SolidBuffer solids_;
};

}  // namespace tangent
