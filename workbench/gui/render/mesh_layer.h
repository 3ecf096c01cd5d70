// The part of the 3D view that changes only with the camera: background, facets, smooth surface, corner
// normals, crease and boundary edges.
#pragma once

#include "workbench/gui/render/scene_buffers.h"
#include "workbench/gui/render/scene_programs.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/gui/render/surface_worker.h"

#include <memory>
#include <optional>
#include <vector>

namespace tangent {

class MeshLayer {
 public:
  void create();
  void set_scene(std::shared_ptr<const ContactScene> scene, NormalForm form);
  /// Uploads what the worker has finished, a slice a call.
  void take_arrays(const SceneFrame& frame);

  /// Draws into the bound framebuffer. `moving`: a coarse stand-in for facets and surface if they are dense.
  void draw(const ScenePrograms& programs, const SceneFrame& frame, const Camera& camera, int width_px, int height_px,
            bool moving);

  std::uint64_t version() const { return version_; }  ///< counts changes of what would be drawn
  bool complete() const { return !scene_ || (smooth_.ready() && stand_in_.ready()); }
  float progress() const { return scene_ ? worker_.progress() : 1.0f; }
  std::size_t smooth_triangles() const { return smooth_.triangles(); }
  void wait() { worker_.wait(); }
  double scale_m() const { return scale_m_; }
  const std::shared_ptr<const ContactScene>& scene() const { return scene_; }
  NormalForm form() const { return form_; }

 private:
  void refresh_strokes(const SceneFrame& frame);
  void draw_facets(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;
  void draw_surface(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;
  void draw_stand_in(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;
  void use_surface_program(const ScenePrograms& programs, const ViewMatrices& view, Rgba albedo, Rgba back) const;
  bool too_dense_to_move(const SceneToggles& on) const;
  void draw_strokes(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;

  std::shared_ptr<const ContactScene> scene_;
  NormalForm form_ = NormalForm::bernstein;
  double scale_m_ = 1.0;
  std::uint64_t version_ = 0;
  FacetBuffer facets_;
  SurfaceBuffer stand_in_, smooth_;
  std::vector<FeatureEdge> features_;
  StrokeBuffer feature_strokes_, normal_strokes_;
  std::optional<Theme> stroke_theme_;  // whose colours the two hold
  bool normals_built_ = false;
  GlVertexArray no_attributes_;
  SurfaceWorker worker_;
};

}  // namespace tangent
