#include "workbench/gui/platform/scene_shots.h"

#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "workbench/gui/platform/scene_picture.h"
#include "workbench/gui/render/staged_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace tangent {
namespace {

/// A view: object, visible layers, camera.
struct SceneView {
  const char* name;
  const char* shows;
  const char* object;  ///< generated object used without a mesh argument
  double rounding_m;
  Staging staging;
  SceneToggles toggles;
  enum class Aim { whole, contact, planes } aim = Aim::whole;
  double yaw_rad = -0.6, pitch_rad = 0.45;
  bool own_object = false;  ///< named after the object, so that no other is drawn
};

SceneToggles object_toggles() {
  SceneToggles on;
  on.smooth_surface = true;
  on.control_net = false;
  on.planes = false;
  on.cld_inset = false;
  return on;
}

SceneView object_view(const char* name, const char* shows, Vec3 approach) {
  SceneView view{name, shows, name, 1.5e-3, {}, object_toggles()};
  view.staging.approach = approach;
  view.staging.preset.finger.radius_m = 0.010;
  view.own_object = true;
  return view;
}

SceneView control_net_view() {
  SceneView view{
      "control-net", "PN control net of the tracked triangle and its neighbours, labelled", "icosphere", 0.0, {}, {}};
  view.staging.preset.finger.radius_m = 0.005;
  view.toggles.control_normals = view.toggles.control_net_neighbours = view.toggles.control_point_labels = true;
  view.toggles.planes = view.toggles.finger = view.toggles.cld_inset = false;
  view.toggles.force = view.toggles.penetration = false;
  view.staging.approach = {0.0, -0.75, 0.95};
  view.aim = SceneView::Aim::contact;
  return view;
}

SceneView planes_view() {
  SceneView view{"planes", "tangent planes of one tick's iterations, in order", "icosphere", 0.0, {}, {}};
  view.staging.preset.solver.method = Method::paper;
  view.staging.preset.solver.gain_curvature_m = 0.0;  // overshoots where convex: several planes
  view.staging.last_jump_m = 12e-3;
  view.toggles.finger = view.toggles.cld_inset = view.toggles.force = view.toggles.penetration = false;
  view.toggles.control_net = false;
  view.staging.approach = {0.0, -0.75, 0.95};
  view.aim = SceneView::Aim::planes;
  return view;
}

struct Shown {
  bool facets = false, smooth_surface = false, vertex_normals = false;
};

SceneView surface_view(const char* name, const char* shows, const Shown& shown) {
  SceneView view{name, shows, "torus", 0.0, {}, object_toggles()};
  view.toggles.shaded = shown.facets;
  view.toggles.smooth_surface = shown.smooth_surface;
  view.toggles.vertex_normals = shown.vertex_normals;
  view.staging.preset.finger.radius_m = 0.008;
  view.staging.approach = {-0.9, -0.7, 0.8};
  return view;
}

const std::vector<SceneView>& all_views() {
  static const std::vector<SceneView> kViews{
      control_net_view(),
      planes_view(),
      surface_view("facets", "the mesh as the file holds it", {.facets = true}),
      surface_view("smooth-surface", "the smooth surface alone, with its patch borders", {.smooth_surface = true}),
      surface_view("both-surfaces", "the smooth surface over its facets", {.facets = true, .smooth_surface = true}),
      surface_view("normals", "corner normals", {.facets = true, .vertex_normals = true}),
      object_view("cone", "the paper's cone, edges rounded by 1.5 mm", {0.1, -0.6, 1.0}),
      object_view("cylinder", "the paper's cylinder, edges rounded by 1.5 mm", {0.1, -0.5, 1.0}),
      object_view("cube", "the paper's cube, edges rounded by 1.5 mm", {0.5, -0.3, 1.0}),
      object_view("sphere", "the paper's sphere", {0.3, -0.6, 1.0}),
      object_view("tetrahedron", "the paper's tetrahedron, edges rounded by 1.5 mm", {0.1, -0.6, 1.0}),
      object_view("octagon", "the paper's extruded octagon, edges rounded by 1.5 mm", {0.2, -0.5, 1.0}),
      object_view("triangle", "the paper's extruded triangle, edges rounded by 1.5 mm", {0.2, -0.5, 1.0}),
      object_view("hexagon", "the practice object, edges rounded by 1.5 mm", {0.2, -0.5, 1.0}),
  };
  return kViews;
}

Result<std::shared_ptr<const ContactScene>> open_scene(const SceneView& view, const ShotRequest& request) {
  const auto& names = generator_names();
  Result<PolygonMesh> polygons = [&]() -> Result<PolygonMesh> {
    if (request.mesh.empty()) return generate_mesh(view.object, {.rounding_m = view.rounding_m});
    if (std::find(names.begin(), names.end(), request.mesh) != names.end()) return generate_mesh(request.mesh);
    return read_mesh(request.mesh, request.metres_per_unit);
  }();
  if (!polygons) return tl::unexpected(polygons.error());
  Result<ContactMesh> mesh = ContactMesh::build(*polygons, request.mesh_options);
  if (!mesh) return tl::unexpected(mesh.error());
  return ContactScene::build(std::move(*mesh));
}

/// Scales finger, travel and depth, given for a body of 80 mm, to this scene.
Staging fitted(Staging staging, const ContactScene& scene) {
  const double factor = glm::length(scene.mesh().bounds().size()) / 0.12;
  if (factor > 0.5 && factor < 2.0) return staging;
  staging.preset.finger.radius_m *= factor;
  staging.press_m *= factor;
  staging.slide_m = 0.0;
  staging.last_jump_m *= factor;
  return staging;
}

/// Points that must be in the image: the vertices and the finger's box.
std::vector<Vec3> drawn_points(const StagedScene& staged, bool finger) {
  const ContactMesh& mesh = staged.scene->mesh();
  std::vector<Vec3> points;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    for (const Vec3& p : mesh.positions(t)) points.push_back(mesh.origin() + p);
  }
  const double reach = staged.preset.finger.reach_m();
  for (int side = 0; side < 6 && finger; ++side) {
    Vec3 out(0.0);
    out[side / 2] = side % 2 == 0 ? reach : -reach;
    points.push_back(staged.tick.input.finger.position + out);
  }
  return points;
}

Camera aimed_camera(const SceneView& view, const StagedScene& staged, double aspect, bool y_up) {
  Camera camera;
  camera.y_up = y_up;
  camera.yaw_rad = view.yaw_rad;
  camera.pitch_rad = view.pitch_rad;
  const TickOutput& output = staged.tick.output;
  if (view.aim == SceneView::Aim::whole)
    camera.fit(drawn_points(staged, view.toggles.finger), 1.12, aspect);
  else
    camera.frame(world_bounds(*staged.scene), 1.05, ViewRoom{.width = aspect});
  if (view.aim == SceneView::Aim::contact && output.triangle != kNone) {
    const auto p = staged.scene->mesh().positions(output.triangle);
    const Vec3 origin = staged.scene->mesh().origin();
    camera.target = origin + (p[0] + p[1] + p[2]) / 3.0;
    camera.distance_m = 4.4 * std::max(glm::length(p[1] - p[0]), glm::length(p[2] - p[0]));
  }
  if (view.aim == SceneView::Aim::planes && !staged.trace->view().empty()) {
    Box points;
    for (const IterationRecord& it : staged.trace->view()) points.include(it.point);
    camera.target = points.centre();
    camera.distance_m = std::max(4.0 * glm::length(points.size()), 0.05 * camera.scene_radius_m);
  }
  return camera;
}

/// An image of twice the height looks the same at twice the resolution.
double scale_of(const ShotRequest& request) { return request.scale.value_or(std::max(1.0, request.height_px / 720.0)); }

}  // namespace

const std::vector<ShotView>& scene_shot_views() {
  static const std::vector<ShotView> kViews = [] {
    std::vector<ShotView> views;
    for (const SceneView& view : all_views())
      views.push_back({view.name, view.shows, view.own_object ? ShotTakes::nothing : ShotTakes::mesh});
    return views;
  }();
  return kViews;
}

Result<Shot> take_scene_shot(const ShotRequest& request) {
  const auto view =
      std::find_if(all_views().begin(), all_views().end(), [&](const SceneView& v) { return v.name == request.view; });
  Result<std::shared_ptr<const ContactScene>> scene = open_scene(*view, request);
  if (!scene) return tl::unexpected(scene.error());
  Result<std::unique_ptr<OffscreenScreen>> screen = OffscreenScreen::open(request.width_px, request.height_px);
  if (!screen) return tl::unexpected(screen.error());
  SceneRenderer renderer;
  if (Status ready = renderer.init(); !ready) return tl::unexpected(ready.error());

  Staging staging = fitted(view->staging, **scene);
  const Vec3 from = staging.approach;
  if (request.y_up) staging.approach = {from.x, from.z, -from.y};
  const StagedScene staged = stage_finger(*scene, staging);
  renderer.set_scene(*scene, staged.preset.solver.normal_form);
  renderer.wait_for_tessellation();
  SceneFrame frame = staged.frame(view->toggles, request.theme.value_or(Theme::light));
  frame.pixel_scale = scale_of(request);
  const Camera camera =
      aimed_camera(*view, staged, static_cast<double>(request.width_px) / request.height_px, request.y_up);
  const auto picture = [&](std::optional<Rgba> ground) {
    frame.ground = ground;
    draw_scene_picture(**screen, renderer, frame, camera, {request.width_px, request.height_px, scale_of(request)});
    return (*screen)->picture();
  };
  const ContactMesh& mesh = (*scene)->mesh();
  Shot shot{{},
            {mesh_fact(mesh.name(), mesh.triangle_count(), mesh.content_hash()), "of the view",
             unit_fact(request.metres_per_unit), shot_command(request, scale_of(request), frame.theme)}};
  shot.image = request.transparent ? with_alpha_of(picture(rgb_hex(0x000000)), picture(rgb_hex(0xFFFFFF)))
                                   : picture(std::nullopt);
  return shot;
}

}  // namespace tangent
