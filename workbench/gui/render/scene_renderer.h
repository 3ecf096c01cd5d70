// Draws the 3D view into its own texture: mesh, smooth surface, control net, finger, force, iterations.
// Plain data in, pixels out; independent of panels, devices and servo. Needs a current GL 3.3 core context in the
// calling thread, but not ImGui: text and insets on top of the image are drawn by render/scene_overlay.h.
//
// Use, once a frame, before the ImGui draw data is rendered:
//   renderer.render(frame, camera, width_px, height_px);
//   ImGui::Image(texture id, size, {0, 1}, {1, 0});             // GL's rows count from the bottom
//   draw_scene_overlay(draw_list, top_left, pixels_per_point, top, renderer, frame, camera, fonts);
#pragma once

#include "core/base/result.h"
#include "core/tick/step.h"
#include "workbench/gui/render/camera.h"
#include "workbench/gui/render/surface_paint.h"
#include "workbench/gui/theme/palette.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace tangent {

struct SceneToggles {
  bool shaded = true;     ///< flat facets of the mesh
  bool wireframe = true;  ///< facet edges; if only the smooth surface is shown, its patch borders
  bool creases = true;    ///< crease and boundary edges
  bool vertex_normals = false;
  bool smooth_surface = false;          ///< the PN surface; translucent over the facets when both are on
  bool control_net = true;              ///< of the tracked (or picked) triangle: ten control points and their net
  bool control_normals = false;         ///< its six control normals
  bool control_net_neighbours = false;  ///< also of the three triangles across its edges
  bool control_point_labels = false;    ///< b300 ... b111 (and n200 ... with control_normals)
  bool finger = true;
  bool penetration = true;  ///< the finger's lowest point to the contact
  bool force = true;        ///< arrows, computed and felt; their scale is in force_metres_per_newton()
  bool contact = true;
  bool tracked_plane = false;  ///< the plane after the tick
  bool planes = true;          ///< the tangent planes of the tick's iterations, joined by a line
  bool trail = false;          ///< past contacts (SceneFrame::trail)
  bool cld_inset = true;       ///< overlay: fingerpad from the side and the roller
  bool colour_bar = true;      ///< overlay: iteration order
  bool axes = true;            ///< overlay: orientation triad and scale bar
  bool operator==(const SceneToggles&) const = default;
};

/// `still` draws the best quality at once (shots, tests); `automatic` draws a cheaper image while the camera moves (no
/// multisampling, coarser smooth surface) and refines it when the camera rests.
enum class RenderQuality : std::uint8_t { automatic, still };

/// Contents of a frame. World frame, metres. Spans must be valid during the call only.
struct SceneFrame {
  SceneToggles toggles;
  Theme theme = Theme::dark;
  std::optional<Rgba> ground = std::nullopt;  ///< behind everything, plain; none: the theme's
  RenderQuality quality = RenderQuality::automatic;
  double pixel_scale = 1.0;  ///< widths of lines and points; 2 on a HiDPI screen
  Finger finger;
  std::optional<TickRecord> tick;                 ///< the tick in view; none: mesh only
  std::span<const IterationRecord> beside_trace;  ///< of the same tick under another preset; empty: none
  std::span<const IterationRecord> trace;  ///< iterations of that tick, stepped again with a trace; [0]: kept plane
  std::optional<std::size_t> selected_iteration;
  std::uint32_t picked_triangle = kNone;  ///< outlined; its control net is shown if no triangle is tracked
  std::uint32_t hovered_triangle = kNone;
  std::span<const std::uint32_t> marked_triangles;  ///< outlined
  bool net_of_picked = false;                       ///< control net of the picked instead of the tracked triangle
  double display_travel_m = 0.016;                  ///< preset.display.travel_m, for the inset
  std::optional<Vec3> felt_force_n;  ///< what the safety gate let through in that tick; none: there is no gate
  std::optional<double> cld_commanded_m;
  std::optional<double> cld_measured_m;
  std::span<const Vec3> trail;  ///< past contacts, oldest first
  std::optional<MapPaint> map;  ///< colours of facets and surface
  std::optional<SlicePlane> slice;
  std::shared_ptr<const Isolation> isolation;  ///< null: all triangles
};

/// A label that the overlay draws beside a 3D point, in pixels of the view (top left is 0, 0).
struct SceneLabel {
  Vec2 pixel{0.0};
  std::string text;
  Rgba colour;
  Vec2 away{0.0, -1.0};  ///< unit, on screen: towards the free side of the point
};

class SceneRenderer {
 public:
  SceneRenderer();
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  /// Loads the shaders. Fails with file:line and the compiler's message.
  Status init();

  /// Sets the mesh to draw; a worker thread tessellates the smooth surface. nullptr: empty view. Cheap when scene and
  /// form are unchanged.
  void set_scene(std::shared_ptr<const ContactScene> scene, NormalForm form);

  /// Draws into the texture; false when the size is below 1 pixel or refused by the driver.
  /// Precondition: init() succeeded.
  bool render(const SceneFrame& frame, const Camera& camera, int width_px, int height_px);

  unsigned texture() const;  ///< GL_TEXTURE_2D, RGBA8, sRGB values; 0 before the first render
  /// Grows with every new picture in the texture: while it stays the same the texture does.
  std::uint64_t picture_version() const;
  int width_px() const;
  int height_px() const;
  std::span<const SceneLabel> labels() const;  ///< of the last render

  /// Share of the smooth surface that is tessellated, 0..1.
  float tessellation_progress() const;
  std::size_t tessellation_triangles() const;  ///< of the finished surface, 0 before
  /// Blocks until the smooth surface is tessellated: for shots and tests, never in the window.
  void wait_for_tessellation();
  /// True while a finer image is still being prepared (camera just rested, surface arriving): keep drawing.
  bool refining() const;

  double force_metres_per_newton() const;  ///< length scale of the force arrow in the last render

  /// Reloads shader files that changed on disk. Call it regularly. On an error the last working ones stay in use.
  void reload_changed_shaders();
  const std::string& shader_error() const;  ///< empty: none

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// First facet under a pixel that is not hidden by slice or isolation.
NearestTriangles::RayHit pick_triangle(const ContactScene& scene, const Camera& camera, const Vec2& pixel, int width_px,
                                       int height_px, const std::optional<SlicePlane>& slice = {},
                                       const Isolation* isolation = nullptr);
/// World box of the scene, for Camera::frame.
Box world_bounds(const ContactScene& scene);

}  // namespace tangent
