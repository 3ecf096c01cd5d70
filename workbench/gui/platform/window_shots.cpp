#include "workbench/gui/platform/window_shots.h"

#include "core/io/polygon_io.h"
#include "core/preset/schema.h"
#include "workbench/gui/app.h"
#include "workbench/gui/model/app_model.h"
#include "workbench/gui/model/file_origin_of.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/platform/bring_up_shots.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/platform/save_picture.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/session/own_folder.h"
#include "workbench/session/window_settings.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace tangent {
namespace {

constexpr std::uint64_t kTicks = 12'000;      // of simulated exploration before the picture ...
constexpr std::uint64_t kMostTicks = 24'000;  // ... and on until the contact is well in view, where it ever was
constexpr std::uint64_t kTicksPerFrame = 50;
constexpr int kLayoutFrames = 4;       // ImGui lays out over some frames
constexpr double kFrame = 1.0 / 60.0;  // s

struct WindowView {
  const char* name;
  const char* shows;
  Theme theme;
  void (*arrange)(AppModel& model);  ///< before the ticks
  void (*look)(AppModel& model);     ///< after them
  int key = 0;                       ///< GLFW key pressed at the end; 0: none
  bool ctrl = false;                 ///< with it
  PlotsMode plots = PlotsMode::time;
  bool values = false;
};

/// Whether the contact is on the upper side of the body, off the middle.
bool contact_in_view(const AppModel& model) {
  const ServoRecord* record = model.time().tick().record();
  if (record == nullptr) return false;
  const Vec3& normal = record->tick.output.normal;
  const double upwards = model.view().camera.y_up ? normal.y : normal.z;
  return upwards > 0.75 && upwards < 0.95;
}

/// Camera at the side of the contact, whole mesh in view.
void look_from_contact_side(AppModel& model) {
  const ServoRecord* record = model.time().tick().record();
  if (record == nullptr || model.scene().current() == nullptr) return;
  Camera& camera = model.view().camera;
  const Vec3& normal = record->tick.output.normal;
  // yaw 0 looks from -y: the eye stands beside the contact's normal.
  camera.yaw_rad = std::atan2(normal.x, camera.y_up ? normal.z : -normal.y) + 1.2;
  camera.pitch_rad = 0.5;
  Box box = world_bounds(*model.scene().current());
  const Vec3 reach(0.8 * model.presets().current().finger.reach_m());
  if (model.view().toggles.finger) {
    box.include(record->tick.input.finger.position - reach);
    box.include(record->tick.input.finger.position + reach);
  }
  camera.frame(box, 1.0, model.view().rooms);
}

/// Pauses at the tick with the most iterations among the last few thousand.
void look_at_busiest_tick(AppModel& model) {
  const std::uint64_t end = model.time().end_tick();
  const std::uint64_t begin = std::max(model.time().first_tick(), end > 5000 ? end - 5000 : 0);
  std::uint64_t busiest = end > 0 ? end - 1 : 0;
  std::size_t most = 0;
  for (std::uint64_t tick = begin; tick < end; ++tick) {
    model.time().select_tick(tick);
    const std::size_t count = model.time().tick().iterations().size();
    if (count > most && contact_in_view(model)) most = count, busiest = tick;
  }
  model.time().select_tick(busiest);
  look_from_contact_side(model);
  Box points;
  for (const IterationRecord& it : model.time().tick().iterations()) points.include(it.point);
  Camera& camera = model.view().camera;
  if (points.empty()) return;
  camera.target = points.centre();
  camera.pitch_rad = 0.75;
  camera.distance_m = std::max(6.0 * glm::length(points.size()), 0.01 * camera.scene_radius_m);
}

void show_surface(AppModel& model) { model.view().toggles.smooth_surface = true; }

/// The paper's method with a gain too small for this curvature: it oscillates before it converges.
void solve_with_paper(AppModel& model) {
  const auto set = [&](std::string_view key, double value) {
    model.presets().set_value(*find_preset_key("solver", key), value);
  };
  set("method", static_cast<double>(Method::paper));
  set("gain_curvature_m", 4e-3);
  // Hides layers that would cover the planes or the finger's depth.
  SceneToggles& on = model.view().toggles;
  on.finger = on.force = on.cld_inset = false;
}

void enlarge_plots(AppModel& model) {
  model.window().sizes().plots = 420.0f;
  model.window().sizes().show_right = false;
}

/// Shows the tab with this section of the right column, and folds the others.
void fold_but(AppModel& model, const char* section) {
  for (const TaskSection& other : kTaskSections)
    model.window().open_sections()[std::string(other.title)] = other.title == section;
  model.window().set_task(task_with(section, model.window().task()));
}

/// The whole body, coloured by a map.
template <MapQuantity quantity>
void show_map(AppModel& model) {
  MapView& map = model.map();
  map.set_quantity(quantity);
  map.on = true;
  fold_but(model, "Map");
  SceneToggles& on = model.view().toggles;
  on.smooth_surface = true;
  on.shaded = on.finger = on.force = on.control_net = on.planes = on.penetration = on.contact = on.cld_inset = false;
}

/// The same under the paper's method.
template <MapQuantity quantity>
void show_paper_map(AppModel& model) {
  model.presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  show_map<quantity>(model);
}

/// The paper's method with a gain that oscillates where the body is convex.
void show_failures(AppModel& model) {
  model.presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 2.5e-3);
  show_paper_map<MapQuantity::failures>(model);
}

void tune_paper(AppModel& model) {
  model.presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  model.window().sizes().plots = 240.0f;
}

/// Pauses and lowers the gain: the recorded past, and the ghost under the new gain.
void drag_gain_of_the_past(AppModel& model) {
  fold_but(model, "Time machine");
  model.time().set_paused(true);
  const std::uint64_t end = model.time().end_tick();
  model.time().select_tick(end > 2600 ? end - 2600 : 0);
  look_from_contact_side(model);
  model.time().add_bookmark();
  model.time().bookmarks().set_note(model.time().bookmarks().all().front().id, "over the inner side");
  model.time().axis().show(static_cast<double>(end) - 4000.0, static_cast<double>(end));
  model.presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 9e-3);
}

/// The busiest tick, and the same tick under a larger gain beside it.
void compare_busiest_tick(AppModel& model) {
  look_at_busiest_tick(model);
  model.presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 12e-3);
}

/// The map's worst place, solved there, and under a larger gain beside it.
void solve_at_worst(AppModel& model) {
  model.solve_at_worst();
  model.presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 12e-3);
  const PlacedTick* placed = model.time().placed();
  if (placed == nullptr) return;
  Box points;
  for (const IterationRecord& it : model.time().tick().iterations()) points.include(it.point);
  model.view().camera.target = points.centre();
  model.view().camera.distance_m =
      std::max(12.0 * glm::length(points.size()), 0.02 * model.view().camera.scene_radius_m);
  model.window().open_sections()["Iterations"] = true;
}

/// The busiest tick, why it was, and the past with the cure beside it.
void explain_busiest_tick(AppModel& model) {
  fold_but(model, "Why this tick");
  look_at_busiest_tick(model);
  if (model.why().of_tick_in_view() != nullptr && model.why().can_try()) model.why().try_cure();
}

void map_with_paper(AppModel& model) {
  solve_with_paper(model);
  model.map().set_quantity(MapQuantity::iterations_worst);
  model.map().on = true;
}

/// A sweep of G_k over the last seconds, and a value tried by hand.
void sweep_gain(AppModel& model) {
  fold_but(model, "Sweep");
  look_from_contact_side(model);
  model.time().set_paused(true);
  model.tuning().set_range(0, 0.0, 30e-3);
  model.tuning().set_count(0, 21);
  model.tuning().start_sweep();
  model.presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 13.6e-3);
}

/// A field of G_k and G_o.
void sweep_two_gains(AppModel& model) {
  fold_but(model, "Sweep");
  look_from_contact_side(model);
  model.time().set_paused(true);
  model.tuning().set_key(1, find_preset_key("solver", "gain_overall"));
  model.tuning().set_range(0, 0.0, 30e-3);
  model.tuning().set_range(1, 0.6, 1.6);
  model.tuning().set_count(0, 13);
  model.tuning().set_count(1, 9);
  model.tuning().start_sweep();
}

/// A front of few planes and small errors, its trials with a small G_k brushed, where they fail, and one trial tried.
void tune_front(AppModel& model) {
  fold_but(model, "Tune");
  model.window().sizes().right = 430.0f;
  model.window().sizes().plots = 170.0f;
  look_from_contact_side(model);
  model.time().set_paused(true);
  TuneModel& tune = model.tune();
  tune.start();
  while (tune.running()) tune.update();
  tune.set_brush(TuneBrush{{TuneAxis{true, 0}, TuneAxis{true, 1}}, {0.0, 0.0}, {0.006, 1e6}});
  tune.show_failures(true);
  if (const auto middle = tune.balanced()) tune.try_trial(*middle);
  SceneToggles& on = model.view().toggles;
  on.smooth_surface = true;
  on.shaded = on.finger = on.force = on.control_net = on.planes = on.penetration = on.contact = on.cld_inset = false;
}

/// G_k by G_d over the last seconds.
void show_heat_map(AppModel& model) {
  fold_but(model, "Sweep");
  model.window().sizes().right = 430.0f;
  model.window().sizes().show_plots = false;
  look_from_contact_side(model);
  model.time().set_paused(true);
  model.tuning().start_heat_map();
}

/// A body with a hole, cut open, with the defects listed and the first one shown.
void inspect(AppModel& model) {
  SceneToggles& on = model.view().toggles;
  on.finger = on.force = on.control_net = on.planes = on.penetration = on.cld_inset = false;
  on.vertex_normals = true;
  fold_but(model, "Inspect");
}

void look_at_first_finding(AppModel& model) {
  if (model.scene().findings() == nullptr) return;
  for (std::size_t k = 0; k < kFindingKindCount; ++k) {
    const auto kind = static_cast<FindingKind>(k);
    if (model.scene().findings()->of(kind).empty()) continue;
    model.view().show_finding(kind, 0);
    model.view().isolate_part();
    return;
  }
}

/// Slot A: the paper's method with a small gain; B: as loaded. Shows the differences and the gain advice.
void tune_and_compare(AppModel& model) {
  for (const char* folded : {"Finger", "Force", "Display", "Safety", "Presets"})
    model.window().open_sections()[folded] = false;
  model.window().toggle_favourite(*find_preset_key("solver", "gain_curvature_m"));
  model.presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  model.presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 6e-3);
  model.presets().set_value(*find_preset_key("solver", "tolerance_m"), 2e-6);
  model.window().sizes().show_plots = false;
}

/// A slice through the body, seen from the cut.
void slice_open(AppModel& model) {
  model.view().toggles.vertex_normals = false;
  look_from_contact_side(model);
  const Camera& camera = model.view().camera;
  model.view().slice = SlicePlane{-camera.forward(), glm::dot(-camera.forward(), camera.target)};
}

/// Paused near the end.
void inspect_plots(AppModel& model) {
  model.time().select_tick(model.time().end_tick() - 900);
  look_from_contact_side(model);
}

/// A 2D scene of its own where no polygon is given: an outline with a corner.
void open_outline(AppModel& model) {
  if (model.scene().current() != nullptr && model.scene().current()->planar() != nullptr) return;
  PlanarPolygon outline{"outline.csv", {}, true};
  for (const Vec2& v : {Vec2{-0.060, -0.030},
                        {0.055, -0.034},
                        {0.055, -0.034},
                        {0.048, 0.018},
                        {0.022, 0.004},
                        {-0.004, 0.012},
                        {-0.018, 0.040},
                        {-0.050, 0.034}})
    outline.vertices.push_back(v);
  if (const auto folder = OwnFolder::make()) {
    const auto path = folder->path() / "tangent-outline.csv";
    if (write_polygon(outline, path)) model.scene().open(path.string());
  }
  model.presets().set_value(*find_preset_key("finger", "radius_m"), 0.008);
  model.presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  model.window().sizes().show_left = false;
  model.window().sizes().plots = 210.0f;
}

/// Pauses at a tick whose tangent lines are distinguishable.
void look_at_busiest_planar_tick(AppModel& model) {
  const std::uint64_t end = model.time().end_tick();
  std::uint64_t busiest = end > 0 ? end - 1 : 0;
  double widest = 0.0;
  for (std::uint64_t tick = end > 6000 ? end - 6000 : 0; tick < end; ++tick) {
    model.time().select_tick(tick);
    const auto trace = model.time().tick().iterations();
    if (trace.size() < 3) continue;
    const double spread = glm::length(trace.front().point - trace.back().point);
    if (spread > widest) widest = spread, busiest = tick;
  }
  model.time().select_tick(busiest);
}

void show_facet_angles(AppModel& model) {
  show_map<MapQuantity::facet_angle>(model);
  model.presets().set_condition(*find_condition("C2"));
}

/// Armed, disturbed, stopped by the gate.
void disturb_devices(AppModel& model) {
  model.view().device_monitor = true;
  Session& session = *model.devices().session();
  session.inject({InjectedFault::delay_burst, 100}, false);
  model.advance(400);
  session.arm();
  model.advance(1500);
  for (std::size_t i = 0; i < model.messages().all().size(); ++i) model.messages().dismiss(i);
}

constexpr WindowView kViews[] = {
    {"overview", "the whole window after 12 s of simulated exploration", Theme::dark, show_surface,
     look_from_contact_side},
    {"light", "the same in the light theme", Theme::light, show_surface, look_from_contact_side},
    {"iterations", "the window paused on the tick with the most iterations of the paper's method", Theme::dark,
     solve_with_paper, look_at_busiest_tick},
    {"map-iterations", "map: planes that the paper's iteration takes, worst of the moves", Theme::dark,
     show_paper_map<MapQuantity::iterations_worst>, look_from_contact_side},
    {"map-failures", "map: share of the moves on which the paper's iteration fails", Theme::dark, show_failures,
     look_from_contact_side},
    {"map-error", "map: error of the paper's iteration against the converged answer", Theme::dark,
     show_paper_map<MapQuantity::error>, look_from_contact_side},
    {"map-curvature", "map: curvature", Theme::light, show_map<MapQuantity::curvature>, look_from_contact_side},
    {"map-touch-radius", "map: largest ball that touches once, over the finger's radius", Theme::dark,
     show_map<MapQuantity::touch_radius>, look_from_contact_side},
    {"map-normals", "map: interpolated normal against the true one", Theme::dark,
     show_map<MapQuantity::normal_deviation>, look_from_contact_side},
    {"map-facet-angle", "heat map of the facets' angles, with the verdict on how smooth it feels", Theme::dark,
     show_facet_angles, look_from_contact_side},
    {"planar", "a 2D scene: polygon, smooth curve, patches, and the tangent lines of a tick", Theme::dark, open_outline,
     look_at_busiest_planar_tick},
    {"map-gain-margin", "map: stability margin of the paper's iteration with the current gains", Theme::dark,
     show_paper_map<MapQuantity::gain_margin>, look_from_contact_side},
    {"time-machine", "the past solved again with a smaller gain, drawn beside what was recorded", Theme::dark,
     tune_paper, drag_gain_of_the_past},
    {"tick-by-tick", "one tick under two gains: planes, path, error curve and table side by side", Theme::dark,
     solve_with_paper, compare_busiest_tick},
    {"solve-here", "a tick at the map's worst place, in its worst direction, under two gains", Theme::light,
     map_with_paper, solve_at_worst},
    {"why", "why a tick took many planes, with the value that cures it tried on the recorded ticks", Theme::dark,
     solve_with_paper, explain_busiest_tick},
    {"sweep", "a sweep of the curvature gain over the recorded ticks", Theme::dark, tune_paper, sweep_gain},
    {"sweep-two", "a sweep of two gains", Theme::light, tune_paper, sweep_two_gains},
    {"tune", "a front of planes and error, brushed: its trials, where they fail, and one of them tried", Theme::dark,
     tune_paper, tune_front},
    {"heat-map", "planes and failures over two gains", Theme::light, tune_paper, show_heat_map},
    {"inspect", "mesh inspection: what it found, marked and listed", Theme::dark, inspect, look_at_first_finding},
    {"slice", "the body cut open", Theme::dark, inspect, slice_open},
    {"parameters", "favourites, gain advice, and two presets side by side", Theme::dark, tune_and_compare,
     look_from_contact_side},
    {"palette", "the command palette", Theme::dark, show_surface, look_from_contact_side, 'P', true},
    {"shortcuts", "the sheet of shortcuts", Theme::dark, show_surface, look_from_contact_side, 290},
    {"monitor", "the device monitor after a delay burst, and re-armed", Theme::dark, show_surface, disturb_devices},
    {"bring-up-home", "a bring-up of the simulated device, before it is homed", Theme::dark, show_bring_up_home,
     nullptr},
    {"bring-up-axes", "... while its axes are found by hand", Theme::dark, show_bring_up_axes, nullptr},
    {"bring-up", "... before a push", Theme::dark, show_bring_up_push, nullptr},
    {"bring-up-result", "... and at its end", Theme::dark, show_bring_up_result, nullptr},
    {"calibration", "a rehearsed calibration by a spring scale, at a reading", Theme::dark, show_calibration, nullptr},
    {"plots", "the window with the plots enlarged", Theme::dark, enlarge_plots, look_from_contact_side},
    {"plots-values", "the plots with their numbers beside them", Theme::dark, enlarge_plots, inspect_plots, 0, false,
     PlotsMode::time, true},
    {"plots-xy", "force in x against force in z", Theme::dark, enlarge_plots, inspect_plots, 0, false, PlotsMode::xy},
    {"plots-spectrum", "spectrum of the force", Theme::dark, enlarge_plots, inspect_plots, 0, false,
     PlotsMode::spectrum},
    {"plots-histogram", "histogram of the force", Theme::light, enlarge_plots, inspect_plots, 0, false,
     PlotsMode::histogram},
};

/// Feeds the app frames of simulated time.
class FrameFeeder {
 public:
  FrameFeeder(OffscreenScreen& screen, App& app, const ShotRequest& request) : screen_(screen), app_(app) {
    // ImGui's coordinates are the image's pixels; the scale enlarges everything in it.
    input_.width = static_cast<float>(request.width_px);
    input_.height = static_cast<float>(request.height_px);
    input_.content_scale = static_cast<float>(request.scale.value_or(1.0));
    input_.dt_s = kFrame;
  }
  void frame() {
    begin();
    screen_.frame([&] { app_.frame(input_); }, app_.ground());
  }
  void unseen_frame() {
    begin();
    screen_.unseen_frame([&] { app_.frame(input_); });
  }
  void press(int key, bool ctrl) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeysDown[key] = true;
    io.KeyCtrl = ctrl;
    frame();
    io.KeysDown[key] = io.KeyCtrl = false;
    frame();
  }

 private:
  void begin() {
    input_.now_s += kFrame;
    if (app_.prepare(input_)) screen_.upload_fonts();
  }

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
  // What a script saves goes where the window puts it, not among the shipped ones.
  if (!request.script.empty()) options.preset_folder = user_presets_path();
  return options;
}

/// Fails if the mesh or preset could not be read. (The window then continues with a default, but a screenshot of that
/// is not what was asked for.)
Status check_start(const AppModel& model) {
  for (const Message& message : model.messages().all()) {
    if (message.severity == Severity::error) return fail(message.text);
  }
  return {};
}

}  // namespace

const std::vector<ShotView>& window_shot_views() {
  static const std::vector<ShotView> kNamed = [] {
    std::vector<ShotView> views;
    for (const WindowView& view : kViews) {
      const bool planar = view.arrange == open_outline;
      views.push_back({view.name, view.shows, planar ? ShotTakes::polygon : ShotTakes::mesh_or_polygon});
    }
    return views;
  }();
  return kNamed;
}

bool explores_on(std::uint64_t done, bool seen, bool in_view) {
  return done < kTicks || (seen && !in_view && done < kMostTicks);
}

/// Without the note on the file, which would be in the next picture.
void save_unannounced(AppModel& model, const PictureRequest& request, const Image& whole) {
  save_picture(model, request, whole, 1.0);
  MessageLog& messages = model.messages();
  if (!messages.all().empty() && messages.all().back().severity == Severity::note)
    messages.dismiss(messages.all().size() - 1);
}

bool is_stopped(const ShotRequest& request) { return request.stop && request.stop(); }
tl::unexpected<Error> interrupted() { return fail("interrupted before the picture was drawn"); }

/// Frames until the script is done, with the pictures that it asks for.
Status run_script(OffscreenScreen& screen, App& app, FrameFeeder& feeder, const ShotRequest& request) {
  while (app.script_running()) {
    if (is_stopped(request)) return interrupted();
    feeder.frame();
    if (const auto file = app.take_screenshot_request())
      if (Status written = write_png(screen.picture(), *file, {.origin = file_origin(app.model())}); !written)
        return written;
    if (const auto picture = app.model().exports().take_picture_request())
      save_unannounced(app.model(), *picture, screen.picture());
  }
  if (!app.script_failure().empty()) return fail(app.script_failure());
  return {};
}

/// Lets the simulated finger explore until the contact is well in view.
Status explore(App& app, FrameFeeder& feeder, const ShotRequest& request) {
  bool seen = false, in_view = false;
  for (std::uint64_t done = 0; explores_on(done, seen, in_view); done += kTicksPerFrame) {
    if (is_stopped(request)) return interrupted();
    app.advance(kTicksPerFrame);
    feeder.unseen_frame();  // without a renderer: only the plots and panels follow
    in_view = contact_in_view(app.model());
    seen = seen || in_view;
  }
  return {};
}

/// The window as it starts, for a script that does the rest.
constexpr WindowView kPlain{"", "", Theme::dark, nullptr, nullptr};

Result<Shot> take_window_shot(const ShotRequest& request) {
  const auto named =
      std::find_if(std::begin(kViews), std::end(kViews), [&](const WindowView& v) { return v.name == request.view; });
  const WindowView& view = request.view.empty() ? kPlain : *named;
  Result<std::unique_ptr<OffscreenScreen>> screen = OffscreenScreen::open(request.width_px, request.height_px);
  if (!screen) return tl::unexpected(screen.error());
  SceneRenderer renderer;
  if (Status ready = renderer.init(); !ready) return tl::unexpected(ready.error());
  App app(app_options(request, view));
  if (Status started = check_start(app.model()); !started) return tl::unexpected(started.error());
  app.model().view().quality = RenderQuality::still;
  app.model().view().camera.y_up = request.y_up;
  FrameFeeder feeder(**screen, app, request);
  feeder.frame();
  if (view.arrange != nullptr) view.arrange(app.model());
  app.show_plots(view.plots, view.values);
  if (view.look != nullptr) {
    if (const Status explored = explore(app, feeder, request); !explored) return tl::unexpected(explored.error());
    view.look(app.model());
  }
  app.set_renderer(&renderer);
  feeder.frame();
  renderer.wait_for_tessellation();
  if (view.key != 0) feeder.press(view.key, view.ctrl);
  if (!request.script.empty()) {
    app.run_script(request.script);
    if (const Status done = run_script(**screen, app, feeder, request); !done) return tl::unexpected(done.error());
  }
  for (int i = 0; i < kLayoutFrames; ++i) feeder.frame();
  FileOrigin origin = file_origin(app.model());
  origin.command = shot_command(request, request.scale.value_or(1.0), request.theme.value_or(view.theme));
  return Shot{(*screen)->picture(), std::move(origin)};
}

}  // namespace tangent
