// Every text that the window draws, in every part of it: none lies over another, none is cut, and each can be read, at
// 80 to 200 % from 900 x 600 up, in all themes.
#include "core/preset/schema.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/drawn_text.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/render/scene_renderer.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

using namespace tangent;
using tangent::test::DrawnText;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::TextRecorder;

namespace {

/// Text that is scrolled sideways: the table of iterations, and fields that are typed in.
bool scrolls(const DrawnText& text) {
  const char* owner = text.list->_OwnerName;
  return owner != nullptr && std::string_view(owner).find("/iterations") != std::string_view::npos;
}

void check_frame(RunningApp& ui, const std::string& state) {
  TextRecorder recorder;
  ui.frame();
  const std::vector<DrawnText> all = recorder.texts();
  const std::vector<double> contrast = test::contrasts(all, ui.app().ground());
  CHECK(all.size() > 20);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const DrawnText& one = all[i];
    INFO(state, ": \"", one.text, "\"");
    CHECK(contrast[i] >= 4.5);
    if (!scrolls(one)) CHECK(std::max(one.cut_left(), one.cut_right()) <= 1.0f);
    for (std::size_t j = 0; j < i; ++j)
      if (one.list == all[j].list && test::collide(one, all[j]))
        FAIL_CHECK(state << ": \"" << one.text << "\" lies over \"" << all[j].text << "\"");
  }
}

/// All sizes of text in two windows, each in another theme; `tabs`: with each tab of the right column. `tall`: in
/// windows of this height, so that all of a long column is in view, with its tab `tune`.
void check_sizes(RunningApp& ui, const std::string& what, bool tabs = false, float tall = 0.0f) {
  std::size_t k = what.size();
  for (const auto& [w, h] : {std::pair{900.0f, 600.0f}, {1280.0f, 720.0f}}) {
    ui.input().width = w;
    ui.input().height = tall > 0.0f ? tall : h;
    for (const float text : {0.8f, 1.0f, 1.5f, 2.0f}) {
      ui.model().window().set_ui_scale(text);
      for (std::size_t t = 0; t < (tabs ? kTaskNames.size() : 1); ++t, ++k) {
        ui.model().window().set_task(tall > 0.0f ? Task::tune : static_cast<Task>(t));
        ui.model().window().sizes().prefer_right = tall > 0.0f || k % 2 == 1;
        ui.model().window().set_theme(static_cast<Theme>(k % kThemeCount));
        ui.frames(3);
        check_frame(ui, what + ", " + std::to_string(static_cast<int>(w)) + " wide, text " +
                            std::to_string(static_cast<int>(100.0f * text)) + " %, tab " + std::string(kTaskNames[t]) +
                            ", theme " + std::to_string(k % kThemeCount));
      }
    }
  }
}

AppOptions on_torus() {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "torus";
  return options;
}

}  // namespace

TEST_CASE("every text of the window has room and can be read, in all tabs, sizes and themes") {
  RunningApp ui(on_torus());
  ui.run(1500);
  check_sizes(ui, "live", true);
  ui.model().map().on = true;
  ui.frames(20);
  check_sizes(ui, "map");
  ui.key(290);
  check_sizes(ui, "shortcuts");
  ui.key(290);
  ui.chord('P');
  ui.frames(2);
  check_sizes(ui, "palette");
}

TEST_CASE("every text of the device monitor after a fault has room and can be read") {
  RunningApp ui(on_torus());
  ui.run(500);
  ui.model().view().device_monitor = true;
  ui.model().devices().session()->inject({InjectedFault::drop_out, 100}, false);
  ui.app().advance(400);
  ui.frames(3);
  check_sizes(ui, "monitor");
}

TEST_CASE("every text of the plots has room and can be read, beside a ghost, cursors and values, in every kind") {
  RunningApp ui(on_torus());
  ui.run(2000);
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.app().advance(2000);
  ui.frame();
  ui.key('K');
  ui.model().time().select_tick(3000);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 9e-3);
  ui.model().tuning().set_key(1, find_preset_key("solver", "gain_overall"));
  ui.model().tuning().set_range(0, 0.0, 30e-3);
  ui.model().tuning().set_range(1, 0.6, 1.6);
  ui.model().tuning().set_count(0, 5);
  ui.model().tuning().set_count(1, 3);
  ui.model().tuning().start_sweep();
  for (int i = 0; i < 2000 && (ui.model().tuning().sweep().running() || ui.model().time().time_machine().busy()); ++i)
    ui.frame();
  check_sizes(ui, "ghost and sweep", true);
  for (const auto mode : {PlotsMode::time, PlotsMode::xy, PlotsMode::spectrum, PlotsMode::histogram}) {
    ui.app().show_plots(mode, true);
    check_sizes(ui, "plots of kind " + std::to_string(static_cast<int>(mode)));
  }
}

TEST_CASE("every text of a front and a heat map has room and can be read, brushed, with a trial in use") {
  RunningApp ui(on_torus());
  ui.run(600);
  for (const char* section : {"Iterations", "Why this tick", "Time machine", "Map", "Smoothness as felt"})
    ui.model().window().open_sections()[section] = false;
  ui.model().window().open_sections()["Tune"] = ui.model().window().open_sections()["Sweep"] = true;
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  TuneModel& tune = ui.model().tune();
  tune.set_trials(40);
  tune.start();
  ui.frame();
  check_sizes(ui, "tuning", false, 2600.0f);
  for (int i = 0; i < 200 && tune.running(); ++i) ui.frame();
  tune.set_objective(2, sweep::find_objective("force_unexplained_worst_n")->column);
  tune.start();
  for (int i = 0; i < 200 && tune.running(); ++i) ui.frame();
  tune.set_brush(TuneBrush{{TuneAxis{true, 0}, TuneAxis{false, 0}}, {0.0, 0.0}, {1.0, 1e9}});
  tune.show_failures(true);
  tune.try_trial(5);
  check_sizes(ui, "front", false, 2600.0f);
  tune.leave_out_search(true);
  ui.model().window().open_sections()["Tune"] = false;
  ui.model().tuning().set_key(1, find_preset_key("solver", "gain_distance_per_m"));
  ui.model().tuning().set_count(0, 5);
  ui.model().tuning().set_count(1, 4);
  ui.model().tuning().start_sweep();
  check_sizes(ui, "heat map", false, 2600.0f);
  ui.model().window().open_sections()["Tune"] = true;
  tune.clear();
  check_sizes(ui, "no pagmo", false, 2600.0f);
}

TEST_CASE("every text of speed against error has room and can be read") {
  RunningApp ui(on_torus());
  ui.run(700);
  ui.model().time().set_selection(TickRange{600, 629});
  ui.model().curves().start();
  REQUIRE(ui.model().curves().curves() != nullptr);
  ui.model().window().open_sections()["Speed against error"] = true;
  ui.model().window().set_task(Task::tune);
  check_sizes(ui, "speed");
}

TEST_CASE("every text of a 2D scene has room and can be read") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh =
      folder.write("outline.csv", "x_m,y_m\n-0.06,-0.03\n0.055,-0.034\n0.048,0.018\n-0.018,0.04\n-0.05,0.034\n");
  RunningApp ui(options);
  ui.run(1500);
  ui.model().time().set_paused(true);
  check_sizes(ui, "2D");
}

TEST_CASE("labels in the 3D view, its cards and the display's inset keep off one another and can be read") {
  const auto context = OffscreenContext::open();
  if (!context) {
    MESSAGE("skipped: " << context.error().message());
    return;
  }
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  RunningApp ui(on_torus());
  ui.run(1500);
  SceneToggles& on = ui.model().view().toggles;
  on.control_point_labels = on.control_normals = on.vertex_normals = true;
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.app().advance(1000);
  ui.app().set_renderer(&renderer);
  check_sizes(ui, "scene");
  ui.app().set_renderer(nullptr);
}
