// Two layers. The mesh layer is redrawn only when camera, toggles or arrays change, multisampled once the camera rests;
// the sketch layer (finger, force, net, iterations) is drawn over a copy of it every frame. This makes a live view
// cheap under software GL: while the finger moves and the camera rests, no mesh triangle is drawn.
#include "workbench/gui/render/scene_renderer.h"

#include "workbench/gui/render/mesh_layer.h"
#include "workbench/gui/render/render_target.h"
#include "workbench/gui/render/scene_sketch.h"
#include "workbench/gui/render/sketch_layer.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace tangent {
namespace {

constexpr int kFramesToRest = 3;  // the camera counts as resting after this many calls without change
constexpr int kSamples = 4;
// Triangles drawn per frame at rest; more are spread over several frames while the stand-in is shown. A software GL
// draws a few million per second.
constexpr std::size_t kSoftwareSlice = 150'000, kHardwareSlice = 8'000'000;
constexpr std::size_t kHardwareMoving = 2'000'000;       // a GPU draws this many per frame while orbiting
constexpr std::uint32_t kSoftwareMultisampled = 30'000;  // triangles; with more a software GL is too slow per frame

/// Everything that determines the mesh layer's image.
struct MeshLayerKey {
  Camera camera;
  SceneToggles toggles;
  Theme theme = Theme::dark;
  int width_px = 0, height_px = 0;
  double pixel_scale = 1.0;
  bool moving = false;
  std::uint64_t arrays = 0, shaders = 0;
  std::optional<SlicePlane> slice;
  std::uint64_t isolation = 0;  // 0: none
  std::optional<Rgba> ground;
  bool operator==(const MeshLayerKey&) const = default;
};

bool same_look(const std::optional<MapPaint>& a, const std::optional<MapPaint>& b) {
  return a.has_value() == b.has_value() && (!a || a->same_look(*b));
}

/// RAII: saves and restores the caller's GL bindings.
class SavedGlState {
 public:
  SavedGlState() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    glGetIntegerv(GL_VIEWPORT, viewport_.data());
  }
  ~SavedGlState() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glBindVertexArray(0);
    glUseProgram(0);
  }

 private:
  GLint draw_ = 0, read_ = 0;
  std::array<GLint, 4> viewport_{};
};

}  // namespace

struct SceneRenderer::Impl {
  ScenePrograms programs;
  MeshLayer mesh;
  SketchLayer sketch_layer;
  Sketch sketch, drawn_sketch;
  std::vector<SceneLabel> labels;
  RenderTarget resting_target, moving_target, resolved, picture;

  MeshLayerKey drawn;
  std::optional<MapPaint> drawn_map;
  DrawProgress progress;
  std::uint64_t mesh_pictures = 0;  ///< grows with every change of the mesh layer
  std::uint64_t resolved_of = 0;    ///< the one that is in `resolved`; 0: none
  struct PictureKey {
    std::uint64_t mesh_pictures = 0, shaders = 0;
    const RenderTarget* target = nullptr;
    int width_px = 0, height_px = 0;
    double pixel_scale = 0.0;
    bool scene = false;
    bool operator==(const PictureKey&) const = default;
  };
  PictureKey drawn_picture;
  std::uint64_t pictures = 0;
  Camera last_camera;
  int calls_at_rest = 0;
  bool resting = true;
  bool software_gl = false;
  double force_metres_per_newton = 0.0;

  bool wants_multisampling(const SceneFrame& frame) const {
    return frame.quality == RenderQuality::still || !software_gl || !mesh.scene() ||
           mesh.scene()->mesh().usable_triangle_count() <= kSoftwareMultisampled;
  }
  void build_sketch(const SceneFrame& frame, const Camera& camera, int width_px, int height_px);
  const RenderTarget& without_samples(const RenderTarget& target);
  const RenderTarget* draw_mesh(const SceneFrame& frame, const Camera& camera, int width_px, int height_px);
};

SceneRenderer::SceneRenderer() : impl_(std::make_unique<Impl>()) {}
SceneRenderer::~SceneRenderer() = default;

Status SceneRenderer::init() {
  if (Status loaded = impl_->programs.load(); !loaded) return loaded;
  impl_->mesh.create();
  impl_->sketch_layer.create();
  const auto* driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view name = driver != nullptr ? driver : "";
  impl_->software_gl = name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos;
  return {};
}

void SceneRenderer::set_scene(std::shared_ptr<const ContactScene> scene, NormalForm form) {
  if (scene != impl_->mesh.scene()) impl_->force_metres_per_newton = 0.0;
  impl_->mesh.set_scene(std::move(scene), form);
}

void SceneRenderer::Impl::build_sketch(const SceneFrame& frame, const Camera& camera, int width_px, int height_px) {
  if (frame.quality == RenderQuality::still) force_metres_per_newton = 0.0;  // independent of earlier frames
  force_metres_per_newton = choose_force_scale(frame, camera, force_metres_per_newton);
  // In units of the distance, so that float coordinates near the target are about one.
  sketch.begin(camera.target, camera.distance_m);
  const SketchContext context{*mesh.scene(), mesh.form(), frame, camera, width_px, height_px, force_metres_per_newton};
  draw_marked_triangles(sketch, context);
  draw_control_nets(sketch, context, labels);
  draw_iterations(sketch, context, labels);
  draw_beside_iterations(sketch, context);  // on top, with smaller dots
  draw_trail(sketch, context);
  draw_force(sketch, context, labels);
  draw_contact(sketch, context, labels);
  if (frame.toggles.finger) draw_finger(sketch, context);
}

/// Draws the next part of the mesh; returns the target to show now, null when it could not be created.
const RenderTarget* SceneRenderer::Impl::draw_mesh(const SceneFrame& frame, const Camera& camera, int width_px,
                                                   int height_px) {
  calls_at_rest = camera == last_camera ? calls_at_rest + 1 : 0;
  last_camera = camera;
  const bool still = frame.quality == RenderQuality::still;
  resting = still || calls_at_rest >= kFramesToRest;
  const std::size_t slice = still ? ~std::size_t{0} : software_gl ? kSoftwareSlice : kHardwareSlice;
  const bool in_slices = resting && mesh.scene() && mesh.drawn_triangles(frame.toggles) > slice;
  const MeshLayerKey key{camera,
                         frame.toggles,
                         frame.theme,
                         width_px,
                         height_px,
                         frame.pixel_scale,
                         !resting,
                         mesh.version(),
                         programs.version,
                         frame.slice,
                         frame.isolation ? frame.isolation->version + 1 : 0,
                         frame.ground};
  const int samples = !resting ? 0 : wants_multisampling(frame) ? kSamples : 0;
  const auto sized = [&](RenderTarget& target, int wanted) {
    // Falls back to no multisampling if the driver can't at this size.
    return target.resize(width_px, height_px, wanted) || target.resize(width_px, height_px, 0);
  };
  RenderTarget& target = resting ? resting_target : moving_target;
  if (!sized(target, samples) || (in_slices && !sized(moving_target, 0))) return nullptr;
  if (!(key == drawn) || !same_look(frame.map, drawn_map)) {
    drawn = key;
    drawn_map = frame.map;
    progress = {};
    ++mesh_pictures;
    if (in_slices) {
      DrawProgress at_once;
      moving_target.bind();
      mesh.draw(programs, frame, camera, width_px, height_px, true, slice, at_once);
    }
  }
  if (!progress.done) {
    ++mesh_pictures;
    target.bind();
    const bool coarse = !resting && (software_gl || mesh.drawn_triangles(frame.toggles) > kHardwareMoving);
    mesh.draw(programs, frame, camera, width_px, height_px, coarse, resting ? slice : ~std::size_t{0}, progress);
  }
  return progress.done ? &target : &moving_target;
}

/// Multisampled pictures are resolved once, not for every finger drawn over them.
const RenderTarget& SceneRenderer::Impl::without_samples(const RenderTarget& target) {
  if (target.samples() == 0 || !resolved.resize(target.width_px(), target.height_px(), 0)) return target;
  if (resolved_of != mesh_pictures) resolved.copy_from(target);
  resolved_of = mesh_pictures;
  return resolved;
}

bool SceneRenderer::render(const SceneFrame& frame, const Camera& camera, int width_px, int height_px) {
  Impl& m = *impl_;
  m.labels.clear();
  if (width_px < 1 || height_px < 1) return false;
  const SavedGlState saved;
  m.mesh.take_arrays(frame);

  const RenderTarget* target = m.draw_mesh(frame, camera, width_px, height_px);
  if (target == nullptr || !m.picture.resize(width_px, height_px, 0)) return false;
  const bool scene = m.mesh.scene() != nullptr;
  if (scene) m.build_sketch(frame, camera, width_px, height_px);
  // The camera is in the key of the mesh layer: a change of it is a new one.
  const Impl::PictureKey key{m.mesh_pictures, m.programs.version, target, width_px,
                             height_px,       frame.pixel_scale,  scene};
  if (key == m.drawn_picture && m.sketch == m.drawn_sketch) return true;
  m.drawn_picture = key;
  m.drawn_sketch = m.sketch;
  ++m.pictures;
  m.picture.copy_from(m.without_samples(*target));
  if (scene) {
    m.picture.bind();
    m.sketch_layer.draw(m.programs, m.sketch, camera, width_px, height_px, static_cast<float>(frame.pixel_scale));
  }
  return true;
}

unsigned SceneRenderer::texture() const { return impl_->picture.texture(); }
std::uint64_t SceneRenderer::picture_version() const { return impl_->pictures; }
int SceneRenderer::width_px() const { return impl_->picture.width_px(); }
int SceneRenderer::height_px() const { return impl_->picture.height_px(); }
std::span<const SceneLabel> SceneRenderer::labels() const { return impl_->labels; }
float SceneRenderer::tessellation_progress() const { return impl_->mesh.progress(); }
std::size_t SceneRenderer::tessellation_triangles() const { return impl_->mesh.smooth_triangles(); }
void SceneRenderer::wait_for_tessellation() { impl_->mesh.wait(); }
bool SceneRenderer::refining() const { return !impl_->resting || !impl_->progress.done || !impl_->mesh.complete(); }
double SceneRenderer::force_metres_per_newton() const { return impl_->force_metres_per_newton; }
void SceneRenderer::reload_changed_shaders() { impl_->programs.reload_changed(); }
const std::string& SceneRenderer::shader_error() const { return impl_->programs.error; }

NearestTriangles::RayHit pick_triangle(const ContactScene& scene, const Camera& camera, const Vec2& pixel, int width_px,
                                       int height_px, const std::optional<SlicePlane>& slice,
                                       const Isolation* isolation) {
  constexpr int kMostLayers = 256;
  const Ray ray = camera.ray_through(pixel, width_px, height_px);
  const ContactMesh& mesh = scene.mesh();
  const double skip = 1e-9 * std::max(glm::length(mesh.bounds().size()), 1e-30);
  const auto left_out = [&](std::uint32_t t) {
    return isolation != nullptr && t < isolation->kept.size() && isolation->kept[t] == 0;
  };
  double gone = 0.0;
  for (int layer = 0; layer < kMostLayers; ++layer) {
    NearestTriangles::RayHit hit =
        scene.nearest().cast(ray.origin - mesh.origin() + gone * ray.direction, ray.direction);
    if (!hit) return hit;
    hit.distance_m += gone;
    const bool cut = slice && slice->cuts(ray.origin + hit.distance_m * ray.direction);
    if (!cut && !left_out(hit.triangle)) return hit;
    gone = hit.distance_m + skip;
  }
  return {};
}

Box world_bounds(const ContactScene& scene) {
  const ContactMesh& mesh = scene.mesh();
  Box box;
  box.include(mesh.bounds().min + mesh.origin());
  box.include(mesh.bounds().max + mesh.origin());
  return box;
}

}  // namespace tangent
