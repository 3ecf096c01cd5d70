#include "workbench/gui/platform/window_shots.h"

#include "workbench/gui/app.h"
#include "workbench/gui/app_model.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/session/preset_schema.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr std::uint64_t kTicks = 12'000;     // of simulated exploration before the picture ...
constexpr std::uint64_t kMostTicks = 24'000; // ... and on until the contact is well in view
constexpr std::uint64_t kTicksPerFrame = 50;
constexpr int kSettlingFrames = 4;           // ImGui lays out over some frames
constexpr double kFrame = 1.0 / 60.0;        // s

struct WindowView {
  const char* name;
  const char* shows;
  Theme theme;
  void (*arrange)(AppModel& model);  ///< before the ticks
  void (*look)(AppModel& model);     ///< after them
};

/// The finger rests on top of the body, leaning to one side.
bool contact_in_view(const AppModel& model) {
  const ServoRecord* record = model.tick().record();
  if (record == nullptr) return false;
  const Vec3& normal = record->tick.output.normal;
  const double upwards = model.view().camera.y_up ? normal.y : normal.z;
  return upwards > 0.75 && upwards < 0.95;
}

/// Camera to the side of the contact, whole mesh in view.
void look_from_contact_side(AppModel& model) {
  const ServoRecord* record = model.tick().record();
  if (record == nullptr || model.scene() == nullptr) return;
  Camera& camera = model.view().camera;
  const Vec3& normal = record->tick.output.normal;
  // yaw 0 looks from -y: the eye stands beside the contact's normal.
  camera.yaw_rad = std::atan2(normal.x, camera.y_up ? normal.z : -normal.y) + 1.2;
  camera.pitch_rad = 0.5;
  Box box = world_bounds(*model.scene());
  const Vec3 reach(0.8 * model.presets().current().finger.reach_m());
  box.include(record->tick.input.finger.position - reach);
  box.include(record->tick.input.finger.position + reach);
  camera.frame(box, 1.0, 1.5);
}

/// The tick with the most iterations among the last few thousand: there is something to see in it.
void look_at_busiest_tick(AppModel& model) {
  const std::uint64_t end = model.end_tick();
  const std::uint64_t begin = std::max(model.first_tick(), end > 5000 ? end - 5000 : 0);
  std::uint64_t busiest = end > 0 ? end - 1 : 0;
  std::size_t most = 0;
  for (std::uint64_t tick = begin; tick < end; ++tick) {
    model.select_tick(tick);
    const std::size_t count = model.tick().iterations().size();
    if (count > most && contact_in_view(model)) most = count, busiest = tick;
  }
  model.select_tick(busiest);
  look_from_contact_side(model);
  Box points;
  for (const IterationRecord& it : model.tick().iterations()) points.include(it.point);
  Camera& camera = model.view().camera;
  if (points.empty()) return;
  camera.target = points.centre();
  camera.pitch_rad = 0.75;
  camera.distance_m = std::max(6.0 * glm::length(points.size()), 0.01 * camera.scene_radius_m);
}

void show_surface(AppModel& model) { model.view().toggles.smooth_surface = true; }

/// The paper's iteration with a gain too small for this ground: it swings before it settles.
void solve_with_paper(AppModel& model) {
  const auto set = [&](std::string_view key, double value) { model.set_value(*find_preset_key("solver", key), value); };
  set("method", static_cast<double>(Method::paper));
  set("gain_curvature_m", 4e-3);
  model.view().toggles.finger = false;
  model.view().toggles.force = false;
}

void enlarge_plots(AppModel& model) {
  model.sizes().plots = 420.0f;
  model.sizes().show_right = false;
}

constexpr WindowView kViews[] = {
    {"overview", "the whole window after 12 s of simulated exploration", Theme::dark, show_surface, look_from_contact_side},
    {"light", "the same in the light theme", Theme::light, show_surface, look_from_contact_side},
    {"iterations", "the window paused on the tick with the most iterations of the paper's method", Theme::dark,
     solve_with_paper, look_at_busiest_tick},
    {"plots", "the window with the plots enlarged", Theme::dark, enlarge_plots, look_from_contact_side},
};

/// Feeds the app frames of simulated time.
class FrameFeeder {
 public:
  FrameFeeder(OffscreenScreen& screen, App& app, const ShotRequest& request) : screen_(screen), app_(app) {
    // The picture's pixels are ImGui's coordinates; the scale makes everything in it larger.
    input_.width = static_cast<float>(request.width_px);
    input_.height = static_cast<float>(request.height_px);
    input_.content_scale = static_cast<float>(request.scale);
    input_.dt_s = kFrame;
  }
  void frame() {
    input_.now_s += kFrame;
    if (app_.prepare(input_)) screen_.upload_fonts();
    screen_.frame([&] { app_.frame(input_); });
  }

 private:
  OffscreenScreen& screen_;
  App& app_;
  FrameInput input_;
};

AppOptions app_options(const ShotRequest& request, const WindowView& view) {
  AppOptions options;
  options.mesh = request.mesh;
  options.metres_per_unit = request.metres_per_unit;
  options.mesh_options = request.mesh_options;
  options.preset = request.preset;
  options.theme = request.theme.value_or(view.theme);
  options.deterministic = true;
  return options;
}

}  // namespace

const std::vector<ShotView>& window_shot_views() {
  static const std::vector<ShotView> kNamed = [] {
    std::vector<ShotView> views;
    for (const WindowView& view : kViews) views.push_back({view.name, view.shows});
    return views;
  }();
  return kNamed;
}

Result<Image> take_window_shot(const ShotRequest& request) {
  const WindowView& view =
      *std::find_if(std::begin(kViews), std::end(kViews), [&](const WindowView& v) { return v.name == request.view; });
  Result<std::unique_ptr<OffscreenScreen>> screen = OffscreenScreen::open(request.width_px, request.height_px);
  if (!screen) return tl::unexpected(screen.error());
  SceneRenderer renderer;
  if (Status ready = renderer.init(); !ready) return tl::unexpected(ready.error());
  App app(app_options(request, view));
  app.model().view().quality = RenderQuality::still;
  app.model().view().camera.y_up = request.y_up;
  FrameFeeder feeder(**screen, app, request);
  feeder.frame();
  view.arrange(app.model());
  for (std::uint64_t done = 0; done < kTicks || (done < kMostTicks && !contact_in_view(app.model())); done += kTicksPerFrame) {
    app.advance(kTicksPerFrame);
    feeder.frame();  // without a renderer: only the plots and panels follow
  }
  view.look(app.model());
  app.set_renderer(&renderer);
  feeder.frame();
  renderer.wait_for_tessellation();
  for (int i = 0; i < kSettlingFrames; ++i) feeder.frame();
  return (*screen)->picture();
}

}  // namespace tangent
