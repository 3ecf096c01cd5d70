// The part of the 3D view that only changes with the camera: background, facets, smooth surface, corner normals, crease
// and boundary edges.
#pragma once

#include "workbench/gui/render/paint_buffers.h"
#include "workbench/gui/render/scene_buffers.h"
#include "workbench/gui/render/scene_programs.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/gui/render/surface_worker.h"

#include <memory>
#include <optional>
#include <vector>

namespace tangent {

/// Progress of drawing one image. A dense mesh is drawn over several frames, so that none takes long.
struct DrawProgress {
  std::size_t next = 0;  ///< next triangle, counted over all passes
  bool done = false;
};

class MeshLayer {
 public:
  void create();
  void set_scene(std::shared_ptr<const ContactScene> scene, NormalForm form);
  /// Uploads finished arrays of the worker, a slice per call.
  void take_arrays(const SceneFrame& frame);

  /// Draws about `budget` triangles into the bound framebuffer, continuing at `progress`. `moving`: draws a coarse
  /// stand-in at once where facets and surface are dense.
  void draw(const ScenePrograms& programs, const SceneFrame& frame, const Camera& camera, int width_px, int height_px,
            bool moving, std::size_t budget, DrawProgress& progress);
  /// Number of triangles in a complete image.
  std::size_t drawn_triangles(const SceneToggles& on) const;

  std::uint64_t version() const { return version_; }  ///< counts changes of the image
  bool complete() const { return !scene_ || (smooth_.ready() && stand_in_.ready() && !facets_.pending()); }
  float progress() const { return scene_ ? worker_.progress() : 1.0f; }
  std::size_t smooth_triangles() const { return smooth_.triangles(); }
  void wait() { worker_.wait(); }
  double scale_m() const { return scale_m_; }
  const std::shared_ptr<const ContactScene>& scene() const { return scene_; }
  NormalForm form() const { return form_; }

 private:
  enum class PassKind : std::uint8_t { facets, surface_depth, surface };
  struct Pass {
    PassKind kind;
    std::size_t triangles;
  };
  std::vector<Pass> passes(const SceneToggles& on) const;
  void refresh_strokes(const SceneFrame& frame);
  void clear_background(const ScenePrograms& programs, const SceneFrame& frame) const;
  void draw_pass(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view, PassKind kind,
                 std::size_t first, std::size_t count) const;
  void use_facet_program(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;
  void use_surface_program(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;
  void draw_stand_in(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;
  void apply_paint(const ShaderProgram& program, const SceneFrame& frame) const;
  bool too_dense_to_move(const SceneToggles& on) const;
  void draw_strokes(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const;
  glm::vec4 slice_of(const SceneFrame& frame) const;

  std::shared_ptr<const ContactScene> scene_;
  NormalForm form_ = NormalForm::bernstein;
  double scale_m_ = 1.0;
  std::uint64_t version_ = 0;
  FacetBuffer facets_;
  SurfaceBuffer stand_in_, smooth_;
  IndexedBuffer stand_in_sources_;
  bool stand_in_has_sources_ = false;
  PaintBuffers paint_;
  std::vector<FeatureEdge> features_;
  StrokeBuffer feature_strokes_, normal_strokes_;
  std::optional<Theme> stroke_theme_;  // whose colours the two hold
  bool normals_built_ = false;
  GlVertexArray no_attributes_;
  SurfaceWorker worker_;
};

}  // namespace tangent
