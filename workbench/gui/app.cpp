#include "workbench/gui/app.h"

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/save_panel.h"
#include "workbench/gui/panels/script_runner.h"
#include "workbench/gui/panels/session_view.h"
#include "workbench/gui/widgets/keyboard_focus.h"
#include "workbench/gui/widgets/thread_time.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

namespace tangent {

struct App::Ui {
  SceneRenderer* renderer = nullptr;
  ItemMap items;
  KeyboardFocus keyboard;
  Typing typing;
  Resting resting;
  ThemeFonts fonts;
  std::optional<float> font_scale;  ///< for which the atlas was built
  std::optional<Theme> theme;       ///< for which the style was set
  MenuBar menu;
  ScriptRunner script;
  bool script_by_hand = false;  ///< it was given in the window, not with the options
  PresetsPanel presets;
  ComparePanel compare;
  IterationsPanel iterations;
  MapPanel map;
  FoldedPanel mesh, devices, time_machine, why, recording, recording_pair{false}, sweep{false}, curves{false};
  TunePanel tune;
  LogPanel log;
  BookmarksPanel bookmarks;
  InspectPanel inspect;
  PerceptionPanel perception;
  bool left_scrolls = false, right_scrolls = false;
  ViewPanel view;
  PlotsPanel plots = make_plots_panel();

  std::optional<ViewValues> session_view;  ///< of a session that was opened
  int camera_frames = 0;                   ///< it is given its camera so many times more

  void take_view(AppModel& model);
  void draw_splitters(const UiContext& ui, WindowModel& window, const Layout& layout);
  void draw_column(const char* name, const Rect& rect, const UiContext& ui, AppModel& model, bool left);
};

namespace {

/// The view without the cards at its left edge, where there is room enough beside them.
Rect beside_cards(const Rect& view, float cards) {
  if (view.w < 2.0f * cards) return view;
  return {view.x + cards, view.y, view.w - cards, view.h};
}

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoNav;

}  // namespace

App::App(AppOptions options) : model_(std::make_unique<AppModel>(options)), ui_(std::make_unique<Ui>()) {
  ImGui::GetIO().IniFilename = nullptr;
  if (!options.script.empty())
    run_script(options.script);
  else if (model_->window().first_start())
    ui_->menu.first.step = 0;
}

void App::run_script(const std::filesystem::path& file) {
  if (const Status loaded = ui_->script.load(file); !loaded) script_failure_ = loaded.error().message();
}

App::~App() = default;

void App::set_renderer(SceneRenderer* renderer) { ui_->renderer = renderer; }

bool App::prepare(const FrameInput& input) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {input.width, input.height};
  io.DeltaTime = static_cast<float>(std::clamp(input.dt_s, 1e-6, 1.0));
  const float scale = std::clamp(input.content_scale * model_->window().ui_scale(), 0.5f, 6.0f);
  const bool fonts = ui_->font_scale != scale;
  if (fonts || ui_->theme != model_->window().theme()) apply_theme(model_->window().theme(), scale);
  ui_->theme = model_->window().theme();
  if (!fonts) return false;
  std::vector<std::string> missing;
  ui_->fonts = load_fonts(scale, missing);
  for (std::string& line : missing) model_->messages().say(Severity::warning, std::move(line));
  ui_->font_scale = scale;
  return true;
}

/// A jump in time moves the camera, and so does a scene that is framed: it is set again in the frames that follow.
void App::Ui::take_view(AppModel& model) {
  if (auto given = model.take_view()) {
    session_view = std::move(*given);
    show_view(model, plots, *session_view);
    camera_frames = 3;
  }
  if (camera_frames == 0) return;
  show_camera(model, *session_view);
  show_scroll(*session_view);
  if (--camera_frames == 0) session_view.reset();
}

void App::Ui::draw_splitters(const UiContext& ui, WindowModel& window, const Layout& layout) {
  const auto splitter = [&](const char* name, const Rect& rect, bool vertical) {
    if (rect.w < 1.0f || rect.h < 1.0f) return ImVec2(0, 0);
    ImGui::SetNextWindowPos({rect.x, rect.y});
    ImGui::SetNextWindowSize({rect.w, rect.h});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.window);
    ImGui::Begin(name, nullptr, kFixed);
    ImGui::InvisibleButton("##bar", {rect.w, rect.h});
    items.note_last(name + 2);
    tooltip(ui, "Drag to resize");
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (lit) ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    if (lit)
      ImGui::GetWindowDrawList()->AddRectFilled({rect.x, rect.y}, {rect.right(), rect.bottom()},
                                                ui.colours.accent_soft);
    const ImVec2 delta = ImGui::IsItemActive() ? ImGui::GetIO().MouseDelta : ImVec2(0, 0);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    return delta;
  };
  LayoutSizes& sizes = window.sizes();
  sizes = drag_left(sizes, splitter("##splitter/left", layout.left_splitter, true).x, ui.scale);
  const float dx = splitter("##splitter/right", layout.right_splitter, true).x;
  if (dx != 0.0f) sizes = drag_right(sizes, dx, layout.right.w, ui.scale);
  const float dy = splitter("##splitter/plots", layout.plot_splitter, false).y;
  if (dy != 0.0f) sizes = drag_plots(sizes, dy, layout.plots.h, ui.scale);
}

void App::Ui::draw_column(const char* name, const Rect& rect, const UiContext& ui, AppModel& model, bool left) {
  if (rect.w < ui.px(40) || rect.h < ui.px(30)) return;
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  // Always reserves room for the scroll bar, so that nothing jumps when a section is folded.
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav |
      ImGuiWindowFlags_AlwaysVerticalScrollbar | ImGuiWindowFlags_NoBackground;
  bool& scrolls = left ? left_scrolls : right_scrolls;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(8), ui.px(4)));
  if (!scrolls) ImGui::PushStyleColor(ImGuiCol_ScrollbarGrab, IM_COL32_BLACK_TRANS);
  ImGui::Begin(name, nullptr, flags);
  if (!scrolls) ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  scrolls = ImGui::GetScrollMaxY() > 0.0f;
  if (left) {
    draw_parameter_panels(ui, model);
    draw_compare_panel(ui, model, compare);
    draw_presets_panel(ui, model, presets);
  } else {
    const auto shown = [tab = model.window().task()](const char* title) { return shows(tab, title); };
    if (shown("Iterations")) draw_iterations_panel(ui, model, iterations);
    if (shown("Why this tick")) draw_why_panel(ui, model, why);
    if (shown("Time machine")) draw_time_machine_panel(ui, model.time(), time_machine);
    if (shown("Tune")) draw_tune_panel(ui, model, tune);
    if (shown("Sweep")) draw_sweep_panel(ui, model, sweep);
    if (shown("Speed against error")) draw_curves_panel(ui, model, curves);
    if (shown("Bookmarks")) draw_bookmarks_panel(ui, model, bookmarks);
    if (shown("Compare recordings")) draw_recording_pair_panel(ui, model, recording_pair);
    if (shown("Map")) draw_map_panel(ui, model, map);
    if (shown("Smoothness as felt")) draw_perception_panel(ui, model, perception);
    if (shown("Inspect")) draw_inspect_panel(ui, model, inspect);
    if (shown("Mesh")) draw_mesh_panel(ui, model, mesh);
    if (shown("Devices")) draw_devices_panel(ui, model, devices);
    if (shown("Recording")) draw_recording_panel(ui, model, recording);
    if (shown("Messages")) draw_log_panel(ui, model.messages(), log);
  }
  ImGui::End();
}

/// Escape stops the force before anything else is looked at, whatever is open, typed or held. ImGui knows of a key that
/// went down only after its NewFrame.
void App::stop_on_escape() {
  const ImGuiIO& io = ImGui::GetIO();
  const int escape = io.KeyMap[ImGuiKey_Escape];
  if (escape >= 0 && io.KeysDown[escape] && io.KeysDownDuration[escape] < 0.0f) stop();
}

void App::stop() { model_->devices().stop(); }

/// A script of the options that fails ends the window, for whoever waits for it; one that a person runs in the window
/// says so there.
void App::step_script() {
  MenuBar& menu = ui_->menu;
  menu.items = &ui_->items;
  menu.title = title();
  const auto say = [&](const std::string& what) { model_->messages().say(Severity::error, what); };
  if (!(menu.wish.script.empty() && menu.wish.lines.empty()) && !ui_->script.running()) {
    const std::string lines = std::exchange(menu.wish.lines, {}), file = std::exchange(menu.wish.script, {});
    const Status loaded = lines.empty() ? ui_->script.load(file) : ui_->script.load_lines(menu.wish.lines_of, lines);
    if (!loaded) say(loaded.error().message());
    ui_->script_by_hand = true;
  }
  if (const std::string file = std::exchange(menu.wish.session, {}); !file.empty())
    save_file(*model_, ui_->plots, SaveWhat::session, file);
  const Status done = ui_->script.step(*model_, menu, ui_->items);
  if (!done && ui_->script_by_hand) say(done.error().message());
  if (!done && !ui_->script_by_hand) script_failure_ = done.error().message();
  if (!ui_->script.running())
    if (const std::string refused = ui_->items.take_refusal(); !refused.empty()) say(refused);
  if (!menu.wish.widget.empty())
    ui_->items.want(std::exchange(menu.wish.widget, {}), std::exchange(menu.wish.value, std::nullopt));
}

void App::frame(const FrameInput& input) {
  stop_on_escape();
  const double begin = thread_cpu_ms();
  for (const std::string& file : input.dropped_files) model_->open(file);
  model_->update(input.now_s);
  ui_->take_view(*model_);
  step_script();
  model_->see_mesh_of_tick();
  const Theme theme = ui_->theme.value_or(model_->window().theme());
  const float scale = ui_->font_scale.value_or(1.0f);
  ImGui::NewFrame();
  if (!refuse_by_enter(model_->guard())) ui_->keyboard.update(ui_->items, theme_colours(theme).accent);
  ui_->items.begin_frame();
  const UiContext ui{ui_->items,
                     ui_->typing,
                     ui_->resting,
                     theme_colours(theme),
                     palette(theme),
                     ui_->fonts,
                     model_->window().open_sections(),
                     scale,
                     input.now_s,
                     &model_->window().section_wanted()};
  model_->window().set_room(input.width / scale, input.height / scale);
  const Layout layout = compute_layout(model_->window().sizes(), input.width, input.height, scale);
  handle_shortcuts(*model_, ui_->menu, !ui_->items.arrows_taken());
  model_->map().set_felt_angle(felt_angle_rad(model_->presets(), ui_->perception));
  draw_view_panel(ui, *model_, ui_->view, ui_->renderer, layout.view);
  draw_device_monitor(ui, *model_, layout.view);
  draw_arming_bar(ui, model_->devices(), beside_cards(layout.view, ui.px(210)));
  draw_guard_question(ui, *model_, beside_cards(layout.view, ui.px(210)));
  draw_unsaved_offer(ui, model_->unsaved(), layout.view);
  ui_->draw_column("##left", layout.left, ui, *model_, true);
  const float tabs = draw_task_tabs(ui, model_->window(), layout.right);
  ui_->draw_column("##right", {layout.right.x, layout.right.y + tabs, layout.right.w, layout.right.h - tabs}, ui,
                   *model_, false);
  draw_plots_panel(ui, *model_, ui_->plots, layout.plots);
  draw_transport_bar(ui, *model_, layout.transport);
  draw_status_line(ui, *model_, layout.status, input.last_frame_ms);
  ui_->draw_splitters(ui, model_->window(), layout);
  draw_toasts(ui, *model_, layout.view);
  draw_menu_bar(ui, *model_, ui_->menu, layout.menu);
  const Rect middle{layout.left.right(), layout.menu.bottom(), input.width - layout.left.right() - layout.right.w,
                    layout.transport.y - layout.menu.bottom()};
  draw_first_steps(ui, *model_, ui_->menu, layout.view);
  draw_shortcut_sheet(ui, *model_, ui_->menu,
                      {0.0f, layout.menu.bottom(), input.width, layout.transport.y - layout.menu.bottom()});
  draw_command_palette(ui, *model_, ui_->menu, middle);
  draw_save_panel(ui, *model_, ui_->plots, middle);
  if (!ImGui::IsAnyItemActive()) model_->presets().end_gesture();
  ImGui::Render();
  last_build_ms_ = thread_cpu_ms() - begin - ui_->view.build_ms_outside;
}

void App::show_plots(PlotsMode mode, bool values) {
  ui_->plots.mode = mode;
  ui_->plots.values = values;
}

void App::advance(std::uint64_t ticks) { model_->advance(ticks); }

ImVec4 App::ground() const {
  return ImGui::ColorConvertU32ToFloat4(theme_colours(ui_->theme.value_or(model_->window().theme())).panel);
}

std::uint64_t App::picture_version() const { return ui_->renderer != nullptr ? ui_->renderer->picture_version() : 0; }

bool App::wants_close() const { return model_->window().wants_close() || !script_failure_.empty(); }

bool App::script_running() const { return ui_->script.running(); }

bool App::wants_frames() const {
  const bool refining = ui_->renderer != nullptr && ui_->renderer->refining();
  return !model_->time().paused() || model_->scene().loading() || model_->recordings().busy() ||
         model_->record().recording() || model_->record().writing() || model_->scene().auditing() ||
         model_->map().running() || model_->guard().finding() || model_->time().time_machine().busy() ||
         model_->tuning().sweep().running() || model_->tune().running() || model_->tune().looking_for_failures() ||
         model_->tuning().search().running() || model_->curves().running() || model_->exports().writing() || refining ||
         ui_->script.running();
}

std::optional<std::filesystem::path> App::take_screenshot_request() {
  return model_->exports().take_screenshot_request();
}

std::string App::title() const {
  const auto& scene = model_->scene().current();
  std::string text =
      scene != nullptr ? std::filesystem::path(scene->mesh().name()).filename().string() : std::string("no mesh");
  text += " - " + model_->presets().editor().name() + (model_->presets().editor().changed() ? "*" : "");
  const ServoRecord* record = model_->time().tick().record();
  if (model_->time().paused() && record != nullptr)
    text += printed(" - paused at %.3f s", static_cast<double>(record->tick.tick) * model_->time().tick_period_s());
  return text + " - Tangent Workbench";
}

const ItemMap& App::items() const { return ui_->items; }

}  // namespace tangent
