#include "workbench/gui/render/mesh_layer.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tangent {
namespace {

constexpr std::size_t kTriangleBudget = 300'000;            // of the smooth surface at rest
constexpr std::size_t kMovingTriangles = 40'000;            // above this: the stand-in while moving
constexpr std::size_t kUploadSlice = std::size_t{8} << 20;  // bytes a frame
constexpr float kTowardEye = 8e-4f;  // depth offset of strokes, as a fraction of the distance to the eye

std::vector<Stroke> feature_strokes(const std::vector<FeatureEdge>& edges, const Palette& colours) {
  std::vector<Stroke> strokes;
  strokes.reserve(edges.size());
  for (const FeatureEdge& e : edges) {
    strokes.push_back({e.a, e.b, packed(e.kind == EdgeKind::crease ? colours.crease : colours.boundary), 2.0f});
  }
  return strokes;
}

double mean_edge_m(const ContactMesh& mesh) {
  double total = 0.0;
  std::size_t edges = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    for (std::uint32_t c = 0; c < 3; ++c) total += glm::length(mesh.position(t, (c + 1) % 3) - mesh.position(t, c));
    edges += 3;
  }
  return edges > 0 ? total / static_cast<double>(edges) : 0.0;
}

std::vector<Stroke> corner_normal_strokes(const ContactMesh& mesh, double scale_m, Rgba colour) {
  const double length = 0.6 * mean_edge_m(mesh) / scale_m;
  const auto as_float = [](const Vec3& p) {
    return std::array{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  };
  std::vector<Stroke> strokes;
  std::vector<Vec3> drawn(mesh.vertex_count(), Vec3(0.0));  // last normal drawn there: most corners share it
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Vec3& normal = mesh.normal(t, c);
      if (std::exchange(drawn[mesh.vertex(t, c)], normal) == normal) continue;
      const Vec3 from = mesh.position(t, c) / scale_m;
      strokes.push_back({as_float(from), as_float(from + length * normal), packed(colour), 1.3f});
    }
  }
  return strokes;
}

Rgba inside(const Palette& colours) { return mix(colours.mesh, colours.boundary, 0.35f); }

}  // namespace

void MeshLayer::create() {
  no_attributes_.create();
  paint_.create();
}

void MeshLayer::set_scene(std::shared_ptr<const ContactScene> scene, NormalForm form) {
  if (scene == scene_ && form == form_) return;
  const bool same_mesh = scene == scene_;
  scene_ = std::move(scene);
  form_ = form;
  ++version_;
  if (!same_mesh) {  // another form of the same mesh: keep the old image until the new one is ready
    facets_.clear();
    stand_in_.clear();
    features_.clear();
    stroke_theme_.reset();
  }
  smooth_.clear();
  if (!scene_) return worker_.stop();
  scale_m_ = std::max(0.5 * glm::length(scene_->mesh().bounds().size()), 1e-30);
  worker_.start(scene_, form, scale_m_, kTriangleBudget);
}

void MeshLayer::take_arrays(const SceneFrame& frame) {
  if (std::optional<CoarseArrays> coarse = worker_.take_coarse()) {
    facets_.begin_upload(std::move(coarse->facets));
    stand_in_has_sources_ = !coarse->stand_in.sources.empty();
    if (stand_in_has_sources_) {
      stand_in_sources_.upload(coarse->stand_in.sources.data(), coarse->stand_in.sources.size() * sizeof(std::uint32_t),
                               GL_R32UI);
    }
    stand_in_.begin_upload(std::move(coarse->stand_in));
    features_ = std::move(coarse->edges);
    stroke_theme_.reset();
    ++version_;
  }
  if (std::optional<SurfaceMesh> fine = worker_.take_smooth()) smooth_.begin_upload(std::move(*fine));
  // Still images upload everything at once, the window a slice per frame.
  const std::size_t bytes = frame.quality == RenderQuality::still ? ~std::size_t{0} : kUploadSlice;
  if (facets_.pending() && facets_.continue_upload(bytes)) ++version_;
  if (stand_in_.pending() && stand_in_.continue_upload(bytes)) ++version_;
  if (smooth_.pending() && smooth_.continue_upload(bytes)) ++version_;
  if (scene_) paint_.take(frame.map, frame.isolation, scene_->mesh());
  refresh_strokes(frame);
}

void MeshLayer::refresh_strokes(const SceneFrame& frame) {
  if (stroke_theme_ != frame.theme) {
    feature_strokes_.upload(feature_strokes(features_, palette(frame.theme)), GL_STATIC_DRAW);
    normals_built_ = false;
    stroke_theme_ = frame.theme;
  }
  if (frame.toggles.vertex_normals && !normals_built_ && scene_) {
    normal_strokes_.upload(corner_normal_strokes(scene_->mesh(), scale_m_, palette(frame.theme).normal),
                           GL_STATIC_DRAW);
    normals_built_ = true;
  }
}

void MeshLayer::clear_background(const ScenePrograms& programs, const SceneFrame& frame) const {
  const Palette& colours = palette(frame.theme);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  programs.background.use();
  programs.background.set("top", rgb(frame.ground.value_or(colours.background_top)));
  programs.background.set("bottom", rgb(frame.ground.value_or(colours.background_bottom)));
  glBindVertexArray(no_attributes_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<MeshLayer::Pass> MeshLayer::passes(const SceneToggles& on) const {
  std::vector<Pass> out;
  if (on.shaded || (on.wireframe && !on.smooth_surface)) out.push_back({PassKind::facets, facets_.triangles()});
  if (!on.smooth_surface) return out;
  const SurfaceBuffer& buffer = smooth_.ready() ? smooth_ : stand_in_;
  // Translucent surfaces: a depth pass first, so that only the nearest layer is blended over the facets.
  if (on.shaded) out.push_back({PassKind::surface_depth, buffer.triangles()});
  out.push_back({PassKind::surface, buffer.triangles()});
  return out;
}

std::size_t MeshLayer::drawn_triangles(const SceneToggles& on) const {
  std::size_t sum = 0;
  for (const Pass& pass : passes(on)) sum += pass.triangles;
  return sum;
}

void MeshLayer::draw(const ScenePrograms& programs, const SceneFrame& frame, const Camera& camera, int width_px,
                     int height_px, bool moving, std::size_t budget, DrawProgress& progress) {
  if (progress.next == 0) clear_background(programs, frame);
  progress.done = true;
  if (!scene_) return;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (frame.slice) glEnable(GL_CLIP_DISTANCE0);
  const ViewMatrices view(camera, scene_->mesh().origin(), scale_m_, width_px, height_px);
  const SceneToggles& on = frame.toggles;
  const bool coarse = moving || facets_.pending();  // dense facets take several frames to upload
  if (coarse && (on.shaded || on.smooth_surface) && too_dense_to_move(on)) {
    draw_stand_in(programs, frame, view);
  } else {
    std::size_t begin = 0;
    for (const Pass& pass : passes(on)) {
      const std::size_t end = begin + pass.triangles;
      if (progress.next < end && budget > 0) {
        const std::size_t count = std::min(budget, end - progress.next);
        draw_pass(programs, frame, view, pass.kind, progress.next - begin, count);
        progress.next += count;
        budget -= count;
      }
      begin = end;
    }
    progress.done = progress.next >= begin;
  }
  if (progress.done) {
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    draw_strokes(programs, frame, view);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }
  glDisable(GL_CLIP_DISTANCE0);
}

void MeshLayer::draw_pass(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view,
                          PassKind kind, std::size_t first, std::size_t count) const {
  const bool facets = kind == PassKind::facets;
  if (facets)
    use_facet_program(programs, frame, view);
  else
    use_surface_program(programs, frame, view);
  (facets ? programs.facets : programs.surface).set("first_triangle", static_cast<int>(first));
  const bool blended = facets ? !frame.toggles.shaded : kind == PassKind::surface && frame.toggles.shaded;
  if (blended)
    glEnable(GL_BLEND);
  else
    glDisable(GL_BLEND);
  const GLboolean colour = kind != PassKind::surface_depth;
  glColorMask(colour, colour, colour, colour);
  if (facets)
    facets_.draw(first, count);
  else
    (smooth_.ready() ? smooth_ : stand_in_).draw(first, count);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_BLEND);
}

glm::vec4 MeshLayer::slice_of(const SceneFrame& frame) const {
  if (!frame.slice) return {0.0f, 0.0f, 0.0f, 1.0f};
  const double offset = frame.slice->offset_m - glm::dot(frame.slice->normal, scene_->mesh().origin());
  return {glm::vec3(-frame.slice->normal), static_cast<float>(offset / scale_m_)};
}

void MeshLayer::apply_paint(const ShaderProgram& program, const SceneFrame& frame) const {
  const Palette& colours = palette(frame.theme);
  program.set("slice", slice_of(frame));
  paint_.apply(program, frame.map.has_value(), mix(colours.mesh, colours.background_bottom, 0.45f),
               mix(colours.mesh, colours.text, 0.1f));
}

void MeshLayer::use_facet_program(const ScenePrograms& programs, const SceneFrame& frame,
                                  const ViewMatrices& view) const {
  const Palette& colours = palette(frame.theme);
  const bool fill = frame.toggles.shaded;
  const Rgba wire =
      fill ? with_alpha(colours.mesh_wire, frame.map ? 0.35f : 0.72f) : with_alpha(colours.text_dim, 0.9f);
  programs.facets.use();
  view.apply(programs.facets);
  programs.facets.set("albedo", rgb(colours.mesh));
  programs.facets.set("inside_albedo", rgb(inside(colours)));
  programs.facets.set("wire", rgba(frame.toggles.wireframe ? wire : with_alpha(wire, 0.0f)));
  programs.facets.set("fill", fill ? 1.0f : 0.0f);
  programs.facets.set("width_px", static_cast<float>(frame.pixel_scale));
  programs.facets.set("patch_triangles", 1);
  apply_paint(programs.facets, frame);
}

bool MeshLayer::too_dense_to_move(const SceneToggles& on) const {
  const std::size_t facets = on.shaded ? scene_->mesh().usable_triangle_count() : 0;
  const std::size_t patches = on.smooth_surface ? smooth_.triangles() : 0;
  return facets + patches > kMovingTriangles && stand_in_.ready();
}

void MeshLayer::use_surface_program(const ScenePrograms& programs, const SceneFrame& frame,
                                    const ViewMatrices& view) const {
  const Palette& colours = palette(frame.theme);
  const bool alone = !frame.toggles.shaded;
  programs.surface.use();
  view.apply(programs.surface);
  programs.surface.set("albedo", rgb(colours.smooth_surface));
  programs.surface.set("inside_albedo", rgb(mix(colours.smooth_surface, colours.boundary, 0.4f)));
  programs.surface.set("toward_eye", alone ? 0.0f : 0.25f * kTowardEye);
  programs.surface.set("opacity", alone ? 1.0f : 0.5f);
  const bool borders = alone && frame.toggles.wireframe && smooth_.ready();
  programs.surface.set("wire", rgba(with_alpha(colours.mesh_wire, borders ? 0.55f : 0.0f)));
  programs.surface.set("width_px", static_cast<float>(frame.pixel_scale));
  const unsigned level = smooth_.ready() ? smooth_.level() : 1;
  programs.surface.set("patch_triangles", static_cast<int>(level * level));
  apply_paint(programs.surface, frame);
}

// One opaque pass; the colour tells whether it stands for facets or surface.
void MeshLayer::draw_stand_in(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const {
  const Palette& colours = palette(frame.theme);
  const bool surface = frame.toggles.smooth_surface;
  use_surface_program(programs, frame, view);
  programs.surface.set("albedo", rgb(surface ? colours.smooth_surface : colours.mesh));
  programs.surface.set("inside_albedo", rgb(inside(colours)));
  programs.surface.set("toward_eye", 0.0f);
  programs.surface.set("opacity", 1.0f);
  programs.surface.set("wire", glm::vec4(0.0f));
  programs.surface.set("patch_triangles", stand_in_has_sources_ ? 0 : 1);
  if (stand_in_has_sources_) stand_in_sources_.bind(kSourcesUnit);  // after the paint, which binds its own
  stand_in_.draw();
}

void MeshLayer::draw_strokes(const ScenePrograms& programs, const SceneFrame& frame, const ViewMatrices& view) const {
  programs.strokes.use();
  view.apply(programs.strokes);
  programs.strokes.set("toward_eye", kTowardEye);
  programs.strokes.set("width_scale", static_cast<float>(frame.pixel_scale));
  programs.strokes.set("opacity", 1.0f);
  programs.strokes.set("slice", slice_of(frame));
  if (frame.toggles.creases) feature_strokes_.draw();
  if (frame.toggles.vertex_normals) normal_strokes_.draw();
}

}  // namespace tangent
