// The window driven like a user would, without a window. Model state is what counts.
#include "tests/workbench/gui/headless_app.h"

#include "tests/support/temp_folder.h"
#include "workbench/gui/panels/panels.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <tuple>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

std::filesystem::path fresh_folder(const char* name) {
  const auto folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// 1.5 s of simulated exploration on a sphere.
struct RunningApp : HeadlessApp {
  using HeadlessApp::HeadlessApp;
  void run(std::uint64_t ticks = 1500) {
    app().advance(ticks);
    frame();
    REQUIRE(model().time().end_tick() >= ticks);
  }
};

bool said(const AppModel& model, Severity severity, const char* part) {
  for (const Message& m : model.messages().all()) {
    if (m.severity == severity && m.text.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("clicking Pause freezes the tick in view - live again follows the newest") {
  RunningApp ui;
  ui.run();
  CHECK_FALSE(ui.model().time().paused());
  ui.click("transport/pause");
  REQUIRE(ui.model().time().paused());
  const std::uint64_t frozen = ui.model().time().tick().record()->tick.tick;
  ui.run(200);
  CHECK(ui.model().time().tick().record()->tick.tick == frozen);
  CHECK(ui.model().time().end_tick() > frozen + 100);  // the recording went on
  ui.click("transport/live");
  CHECK_FALSE(ui.model().time().paused());
  CHECK(ui.model().time().tick().record()->tick.tick == ui.model().time().end_tick() - 1);
}

TEST_CASE("buttons and arrow keys step by one tick, back and forth") {
  RunningApp ui;
  ui.run();
  ui.click("transport/pause");
  const std::uint64_t at = ui.model().time().tick().record()->tick.tick;
  ui.click("transport/step_back");
  CHECK(ui.model().time().tick().record()->tick.tick == at - 1);
  ui.key(HeadlessApp::kLeft);
  CHECK(ui.model().time().tick().record()->tick.tick == at - 2);
  ui.key(HeadlessApp::kRight);
  ui.click("transport/step_forward");
  CHECK(ui.model().time().tick().record()->tick.tick == at);
  ui.click("transport/step_forward");  // there is no later one
  CHECK(ui.model().time().tick().record()->tick.tick == ui.model().time().end_tick() - 1);
  ui.key(HeadlessApp::kHome);
  CHECK(ui.model().time().tick().record()->tick.tick == ui.model().time().first_tick());
  ui.key(HeadlessApp::kEnd);
  CHECK_FALSE(ui.model().time().paused());
}

TEST_CASE("full stop and comma walk through the iterations and on into the neighbouring ticks") {
  RunningApp ui;
  ui.run();
  ui.key(HeadlessApp::kSpace);
  REQUIRE(ui.model().time().paused());
  const std::uint64_t at = ui.model().time().tick().record()->tick.tick;
  const std::size_t count = ui.model().time().tick().iterations().size();
  REQUIRE(count >= 1);
  ui.model().time().select_tick(at - 5);
  ui.frame();
  const std::size_t here = ui.model().time().tick().iterations().size();
  for (std::size_t i = 0; i < here; ++i) {
    ui.key('.');
    CHECK(ui.model().time().tick().selected() == i);
  }
  ui.key('.');
  CHECK(ui.model().time().tick().record()->tick.tick == at - 4);
  CHECK(ui.model().time().tick().selected() == std::size_t{0});
  ui.key(',');
  CHECK(ui.model().time().tick().record()->tick.tick == at - 5);
  CHECK(ui.model().time().tick().selected() == here - 1);
}

TEST_CASE("the iterations in view are those of the recorded tick, computed again") {
  RunningApp ui;
  ui.run();
  for (std::uint64_t back : {1u, 77u, 500u}) {
    ui.model().time().select_tick(ui.model().time().end_tick() - back);
    const ServoRecord& record = *ui.model().time().tick().record();
    CHECK(ui.model().time().tick().problem().empty());
    const auto iterations = ui.model().time().tick().iterations();
    REQUIRE(!iterations.empty());
    CHECK(iterations.back().error_m == record.tick.output.error_m);
  }
}

TEST_CASE("a gain that is typed is sent once, on Enter, as a whole preset") {
  RunningApp ui;
  ui.run();
  const std::uint64_t sent = ui.model().presets().sent();
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("1");
  ui.type("3");
  ui.type("4");
  CHECK(ui.model().presets().sent() == sent);  // never 1, 13, 134 on the way
  CHECK(ui.model().presets().current().solver.gain_overall == 1.0);
  for (int i = 0; i < 3; ++i) ui.key(259);
  ui.type("0.75");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.75);
  CHECK(ui.model().presets().sent() == sent + 1);
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 0.75);
  ui.run(5);
  CHECK(ui.model().devices().status().servo.preset_id == ui.model().devices().session()->preset_id());
}

TEST_CASE("a typed value counts when the focus goes elsewhere, and not after Escape") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("0.5");
  ui.click("transport/pause");
  CHECK(ui.model().presets().current().solver.gain_overall == 0.5);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("0.9");
  ui.key(HeadlessApp::kEscape);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.5);
}

TEST_CASE("Tab commits and goes on to the next value") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("0.5");
  ui.key(HeadlessApp::kTab);
  ui.frames(2);
  ui.type("12");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.5);
  CHECK(ui.model().presets().current().solver.gain_curvature_m == doctest::Approx(0.012));
}

TEST_CASE("a typed value out of range is cut to it with a warning - rubbish is refused with an error") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("99");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 10.0);
  CHECK(said(ui.model(), Severity::warning, "solver.gain_overall"));
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("fast");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 10.0);
  CHECK(said(ui.model(), Severity::error, "fast"));
}

TEST_CASE("typing may begin in the frame after the click") {
  RunningApp ui;
  ui.run(50);
  ui.move(ui.centre("solver/gain_overall"));
  ui.press();
  ui.release();
  ui.type("0.375");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.375);
}

TEST_CASE("dragging a value slides it, live - reset brings the program's own value back") {
  RunningApp ui;
  ui.run(50);
  ui.drag("solver/gain_overall", {30.0f, 0.0f});
  const double slid = ui.model().presets().current().solver.gain_overall;
  CHECK(slid > 1.0);
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == slid);
  CHECK(ui.model().presets().editor().changed());
  ui.click("solver/gain_overall/reset");
  CHECK(ui.model().presets().current().solver.gain_overall == 1.0);
  CHECK_FALSE(ui.model().presets().editor().changed());
}

TEST_CASE("a broken preset is refused with a message, and the old one stays") {
  const auto folder = fresh_folder("tangent_app_broken_preset");
  std::ofstream(folder / "broken.toml") << "[solver]\nno_such_key = 1\n";
  std::ofstream(folder / "good.toml") << "[solver]\ngain_overall = 0.25\n";
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder;
  RunningApp ui(options);
  ui.run(50);
  const Preset before = ui.model().presets().current();
  ui.model().presets().load(folder / "broken.toml");
  ui.frame();
  CHECK(ui.model().presets().current() == before);
  CHECK(ui.model().devices().session()->preset() == before);
  CHECK(said(ui.model(), Severity::error, "no_such_key"));
  CHECK(ui.app().items().find("toast/0") != nullptr);
  ui.click("toast/0");
  CHECK(ui.app().items().find("toast/0") == nullptr);
  ui.model().presets().load(folder / "good.toml");
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 0.25);
}

TEST_CASE("a mesh that can't be read leaves the old scene and says why") {
  RunningApp ui;
  ui.run(50);
  const auto scene = ui.model().scene().current();
  ui.input().dropped_files = {"/nowhere/missing.obj"};
  ui.frame();
  CHECK(ui.model().scene().current() == scene);
  CHECK(said(ui.model(), Severity::error, "missing.obj"));
  ui.run(50);
}

TEST_CASE("an unreadable mesh on the command line still opens the window, with the built-in scene") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "/nowhere/missing.obj";
  RunningApp ui(options);
  CHECK(ui.model().scene().current() != nullptr);
  CHECK(said(ui.model(), Severity::error, "missing.obj"));
  ui.run(50);
}

TEST_CASE("a dropped mesh is opened, audited and touched") {
  const auto folder = fresh_folder("tangent_app_drop");
  std::ofstream(folder / "tetra.obj") << "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  RunningApp ui;
  ui.run(50);
  ui.input().dropped_files = {(folder / "tetra.obj").string()};
  ui.frame();
  REQUIRE(ui.model().scene().current() != nullptr);
  CHECK(ui.model().scene().current()->mesh().usable_triangle_count() == 4);
  REQUIRE(ui.model().scene().audit() != nullptr);
  CHECK(ui.model().scene().audit()->usable_triangles == 4);
  ui.run(200);
  CHECK(ui.model().time().tick().problem().empty());
}

TEST_CASE("the wheel over a plot zooms time about the pointer once it is held") {
  RunningApp ui;
  ui.run();
  ui.click("transport/pause");
  const ItemRect rect = *ui.app().items().find("plots/force");
  const ImVec2 at{std::floor(rect.min.x + 0.3f * (rect.max.x - rect.min.x)),
                  std::floor(rect.centre().y)};  // ImGui rounds the mouse down
  const auto tick_at = [&] {
    return ui.model().time().axis().tick_at(static_cast<double>(at.x), static_cast<double>(rect.min.x),
                                            static_cast<double>(rect.max.x - rect.min.x));
  };
  const double before = tick_at(), span = ui.model().time().axis().span();
  ui.wheel(at, 2.0f);
  CHECK(ui.model().time().axis().span() < span);
  CHECK(tick_at() == doctest::Approx(before));
}

TEST_CASE("dragging a plot pans and stops following - clicking it selects that tick") {
  RunningApp ui;
  ui.run();
  REQUIRE(ui.model().time().axis().following());
  ui.model().time().axis().set_span(1000.0);
  ui.frame();
  ui.drag("plots/error", {40.0f, 0.0f});
  CHECK_FALSE(ui.model().time().axis().following());
  CHECK(ui.model().time().axis().to() < 1500.0);
  ui.click("plots/error");
  REQUIRE(ui.model().time().paused());
  const double middle = 0.5 * (ui.model().time().axis().from() + ui.model().time().axis().to());
  CHECK(std::abs(static_cast<double>(ui.model().time().tick().record()->tick.tick) - middle) <= 3.0);
}

TEST_CASE("legend entries hide and show their curve") {
  RunningApp ui;
  ui.run(300);
  CHECK(ui.app().items().find("plots/force/x") != nullptr);
  ui.click("plots/force/x");
  ui.click("plots/force/x");
}

TEST_CASE("dragging in the 3D view orbits, the wheel zooms, F frames, a click picks a triangle") {
  RunningApp ui;
  ui.run(50);
  const Camera before = ui.model().view().camera;
  ui.drag("view", {60.0f, 20.0f});
  CHECK(ui.model().view().camera.yaw_rad != before.yaw_rad);
  CHECK(ui.model().view().picked_triangle == kNone);
  const ImVec2 middle = ui.centre("view");
  ui.wheel(middle, 3.0f);
  CHECK(ui.model().view().camera.distance_m < before.distance_m);
  ui.drag("view", {30.0f, 0.0f}, 1);
  CHECK(glm::length(ui.model().view().camera.target - before.target) > 1e-4);
  ui.key('F');
  Camera framed = ui.model().view().camera;
  framed.frame(world_bounds(*ui.model().scene().current()), 1.05, ui.model().view().rooms);
  CHECK(ui.model().view().camera == framed);
  CHECK(glm::length(framed.target - before.target) < 1e-12);
  ui.click("view");
  CHECK(ui.model().view().picked_triangle != kNone);
}

TEST_CASE("with the hand on the mouse, dragging on the surface leads the finger there") {
  RunningApp ui;
  ui.run(300);
  ui.key('M');
  REQUIRE(ui.model().devices().hand_follows_mouse());
  const Camera before = ui.model().view().camera;
  ui.drag("view", {10.0f, 0.0f});
  CHECK(ui.model().view().camera == before);
  CHECK(ui.model().devices().session()->hand().mode == HandMode::point);
  ui.run(3000);
  const Vec3 finger = ui.model().time().tick().record()->tick.input.finger.position;
  const Vec3 target = ui.model().time().tick().record()->device.hand_target_m;
  CHECK(glm::length(finger - target) < 5e-3);
  CHECK(glm::dot(unit(finger), unit(before.eye() - before.target)) > 0.8);  // on the side that was clicked
  ui.click("menu/hand");
  CHECK(ui.model().devices().session()->hand().mode == HandMode::explore);
}

TEST_CASE("the stop button takes the force away until it is armed again") {
  RunningApp ui;
  ui.run(2000);
  REQUIRE_FALSE(ui.model().devices().stopped());
  ui.click("menu/stop");
  ui.run(20);
  CHECK(ui.model().devices().stopped());
  CHECK(glm::length(ui.model().time().tick().record()->device.force_command_n) == 0.0);
  ui.click("menu/stop");
  ui.run(500);
  CHECK_FALSE(ui.model().devices().stopped());
}

TEST_CASE("splitters give room to their neighbours") {
  RunningApp ui;
  const float left = ui.model().window().sizes().left;
  ui.drag("splitter/left", {40.0f, 0.0f});
  CHECK(ui.model().window().sizes().left == doctest::Approx(left + 40.0f));
  const float view = ui.app().items().find("view")->max.y;
  ui.drag("splitter/plots", {0.0f, -30.0f});
  CHECK(ui.app().items().find("view")->max.y == doctest::Approx(view - 30.0f));
}

TEST_CASE("saving under a name makes a preset file that the list shows") {
  const auto folder = fresh_folder("tangent_app_save");
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder;
  RunningApp ui(options, 1280.0f, 2000.0f);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.4);
  ui.frame();
  ui.click("presets/name");
  ui.type("mine");
  ui.click("presets/save");
  CHECK(std::filesystem::exists(folder / "mine.toml"));
  CHECK_FALSE(ui.model().presets().editor().changed());
  CHECK(ui.app().items().find("presets/file/mine") != nullptr);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.6);
  ui.frame();
  ui.click("presets/revert/solver.gain_overall");
  CHECK(ui.model().presets().current().solver.gain_overall == 0.4);
}

TEST_CASE("the display's controller is tuned in a section of its own, and bounds what the display is sent") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  CHECK(ui.app().items().find("controller/p_per_s2") == nullptr);
  ui.click("section/Display controller");
  ui.frames(2);
  for (const char* key :
       {"i_per_s3", "d_per_s", "target_weight", "lowest_m", "highest_m", "fastest_m_per_s", "largest_current_a"}) {
    CAPTURE(std::string(key));
    CHECK(ui.app().items().find(std::string("controller/") + key) != nullptr);
  }
  ui.click("controller/p_per_s2");
  ui.type("2500");
  ui.key(HeadlessApp::kEnter);
  ui.click("controller/highest_m");
  ui.type("3");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().devices().session()->preset().controller.p_per_s2 == 2500.0);
  CHECK(ui.model().devices().session()->preset().controller.highest_m == doctest::Approx(3e-3));
  ui.run(3000);
  double furthest = 0.0;
  for (std::uint64_t tick = 1000; tick < 3000; ++tick) {
    ui.model().time().select_tick(tick);
    furthest = std::max(furthest, ui.model().time().tick().record()->device.cld_command_m);
  }
  CHECK(furthest == doctest::Approx(3e-3));
}

TEST_CASE("a preset that was there before is written over only when asked for twice") {
  const auto folder = fresh_folder("tangent_app_replace");
  const std::string kept = "[about]\nnote = \"measured\"\n[solver]\ngain_overall = 0.3\n";
  std::ofstream(folder / "mine.toml") << kept;
  const auto on_disk = [&] {
    std::ifstream in(folder / "mine.toml");
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder;
  RunningApp ui(options, 1280.0f, 2000.0f);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.4);
  ui.frame();
  ui.click("presets/name");
  ui.type("mine");
  ui.click("presets/save");
  CHECK(on_disk() == kept);
  CHECK(said(ui.model(), Severity::warning, "Replace"));
  ui.click("presets/save");
  CHECK(read_preset(folder / "mine.toml")->preset.solver.gain_overall == 0.4);
  // One's own work of a moment ago: no question.
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.6);
  ui.frame();
  ui.click("presets/save");
  CHECK(read_preset(folder / "mine.toml")->preset.solver.gain_overall == 0.6);
}

TEST_CASE("frames build at any size and scale, with and without history, for every method") {
  for (const auto& [w, h, scale] : {std::tuple{1280.0f, 720.0f, 1.0f},
                                    {3840.0f, 2160.0f, 1.0f},
                                    {3840.0f, 2160.0f, 2.0f},
                                    {320.0f, 200.0f, 1.0f},
                                    {40.0f, 30.0f, 2.0f}}) {
    CAPTURE(w);
    CAPTURE(scale);
    AppOptions none = HeadlessApp::deterministic_options();
    none.device = "none";
    {
      HeadlessApp empty(none, w, h, scale);
      empty.frames(3);
    }
    RunningApp ui(HeadlessApp::deterministic_options(), w, h, scale);
    for (int method = 0; method < 6; ++method) {
      ui.model().presets().set_value(*find_preset_key("solver", "method"), method);
      ui.run(40);
      ui.frames(2);
    }
    ui.model().window().set_theme(Theme::light);
    ui.model().window().set_ui_scale(1.3f);
    ui.frames(2);
    CHECK(ImGui::GetDrawData()->TotalVtxCount > 0);
  }
}

TEST_CASE("every key of the schema has its row in the panel of its table, wherever it means anything") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  for (const PresetTable& table : preset_tables()) {
    ui.model().window().show_section(std::string(table.title), true);
    ui.frames(2);
    CHECK(ui.app().items().find("section/" + std::string(table.title)) != nullptr);
  }
  const PresetKey& shape = *find_preset_key("finger", "shape");
  std::set<std::string> seen;
  for (std::size_t s = 0; s < shape.choices.size(); ++s) {
    ui.model().presets().set_value(shape, static_cast<double>(s));
    ui.frames(2);
    for (const PresetKey& key : preset_keys()) {
      CAPTURE(key.full_name());
      CAPTURE(s);
      const KeyCondition& c = key.condition;
      const bool meant = c.holds == nullptr || !c.otherwise.empty() || c.holds(ui.model().presets().current());
      const std::string path = std::string(key.table) + "/" + std::string(key.key) + "/label";
      CHECK((ui.app().items().find(path) != nullptr) == meant);
      if (meant) seen.insert(key.full_name());
    }
  }
  CHECK(seen.size() == preset_keys().size());
}

TEST_CASE("another device starts another session, with a history of its own") {
  RunningApp ui;
  ui.run(300);
  ui.click("menu/device");
  ui.click("menu/device/none");
  CHECK(ui.model().devices().name() == "none");
  REQUIRE(ui.model().devices().session() != nullptr);
  CHECK(ui.model().devices().session()->force_capabilities() == nullptr);
  ui.click("menu/device");
  ui.click("menu/device/simulated");
  ui.run(100);
  CHECK(ui.model().time().end_tick() == 100);
  CHECK(ui.model().devices().status().force_state != DeviceState::absent);
}

TEST_CASE("an unknown device is said to be one, and the window still comes up") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.device = "toaster";
  HeadlessApp ui(options);
  ui.frames(3);
  CHECK(ui.model().devices().session() == nullptr);
  CHECK(said(ui.model(), Severity::error, "toaster"));
  ui.click("transport/pause");
  ui.key(HeadlessApp::kLeft);
  ui.key('.');
}

TEST_CASE("a click on a row of the iteration table pauses and selects that iteration - another lets go of it") {
  RunningApp ui;
  ui.run();
  ui.click("iterations/row/0");
  CHECK(ui.model().time().paused());
  CHECK(ui.model().time().tick().selected() == std::size_t{0});
  ui.click("iterations/row/0");
  CHECK_FALSE(ui.model().time().tick().selected().has_value());
}

TEST_CASE("typing 1345 sends 1345 once, never 1, 13 or 134, and undo takes it back whole") {
  RunningApp ui;
  ui.run(50);
  const std::uint64_t sent = ui.model().presets().sent();
  const double before = ui.model().presets().current().force.stiffness_n_per_m;
  ui.click("force/stiffness_n_per_m");
  ui.frame();
  for (const char* digit : {"1", "3", "4", "5"}) {
    ui.type(digit);
    ui.frames(2);
    CHECK(ui.model().presets().sent() == sent);
    CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == before);
  }
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().sent() == sent + 1);
  CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == 1345.0);
  CHECK(ui.model().presets().note(ui.model().devices().session()->preset_id()).find("1345") != std::string::npos);
  ui.chord('Z');
  CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == before);
  ui.chord('Y');
  CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == 1345.0);
}

TEST_CASE("a drag is undone in one step") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  ui.run(50);
  ui.drag("solver/gain_overall", {30.0f, 0.0f});
  ui.drag("solver/gain_overall", {-10.0f, 0.0f});
  ui.chord('Z');
  CHECK(ui.model().presets().current().solver.gain_overall > 1.0);
  ui.chord('Z');
  CHECK(ui.model().presets().current().solver.gain_overall == 1.0);
  ui.click("compare/redo");
  CHECK(ui.model().presets().current().solver.gain_overall > 1.0);
}

TEST_CASE("one key switches between A and B, whole and at once, and the difference is listed and can be taken over") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  ui.run(50);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.4);
  ui.model().presets().set_value(*find_preset_key("finger", "radius_m"), 0.009);
  ui.frame();
  ui.key('B');
  CHECK(ui.model().presets().slots().active_slot() == 1);
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 1.0);
  CHECK(ui.app().items().find("compare/key/finger.radius_m") != nullptr);
  ui.key('B');
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 0.4);
  ui.click("compare/key/solver.gain_overall");  // A on the left, B on the right
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 1.0);
  CHECK(ui.app().items().find("compare/key/solver.gain_overall") == nullptr);
  ui.click("compare/copy");
  ui.key('B');
  CHECK(ui.model().devices().session()->preset().finger.radius_m == 0.009);
}

TEST_CASE("a click on a name makes it a favourite, which is drawn once more on top and works there") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall/label");
  CHECK(ui.model().window().favourites() == std::vector<std::string>{"solver.gain_overall"});
  ui.click("favourites/solver/gain_overall");
  ui.frame();
  ui.type("0.625");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.625);
  ui.click("favourites/solver/gain_overall/label");
  CHECK(ui.model().window().favourites().empty());
  ui.frame();
  CHECK(ui.app().items().find("favourites/solver/gain_overall") == nullptr);
}

TEST_CASE("the gain advice stands under the gains of the paper's method and can be taken") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  ui.run();
  CHECK(ui.app().items().find("solver/advice") == nullptr);  // robust has no gains
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.model().presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 0.001);
  ui.run(50);
  ui.click("solver/advice/set");
  CHECK(ui.model().presets().current().solver.gain_curvature_m == ui.model().presets().current().finger.radius_m);
}

TEST_CASE("a map is chosen in its panel, its worst place gone to, its range dragged at the colour bar") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  ui.run(50);
  ui.click("map/quantity");
  ui.click("map/quantity/Curvature");
  ui.frames(2);
  REQUIRE(ui.model().map().on);
  REQUIRE(ui.model().map().paint().has_value());
  CHECK(ui.app().items().find("view/map_bar") != nullptr);
  const Camera before = ui.model().view().camera;
  ui.click("map/worst/0");
  CHECK(ui.model().view().picked_triangle == ui.model().map().worst()[0].triangle);
  CHECK(glm::length(ui.model().view().camera.target - ui.model().map().worst()[0].point_world) < 1e-12);
  CHECK(ui.model().view().camera.yaw_rad != before.yaw_rad);
  ui.click("map/low");
  ui.frame();
  ui.type("5");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().map().low() == 5.0);
  CHECK_FALSE(ui.model().map().automatic_range());
  const ItemRect bar = *ui.app().items().find("view/map_bar");
  const double high = ui.model().map().high();
  const ImVec2 upper{bar.centre().x, bar.min.y + 60.0f};
  ui.move(upper);
  ui.press();
  ui.move({upper.x, upper.y + 20.0f});
  ui.move({upper.x, upper.y + 40.0f});
  ui.release();
  CHECK(ui.model().map().high() > high);
  CHECK(ui.model().map().low() == 5.0);
  ui.click("map/auto");
  CHECK(ui.model().map().automatic_range());
  ui.click("map/quantity");
  ui.click("map/quantity/None");
  CHECK_FALSE(ui.model().map().paint().has_value());
}

TEST_CASE("a finding is listed, gone to, marked, isolated and left again") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "fin_on_plate";
  RunningApp ui(options, 1280.0f, 2400.0f);
  ui.frame();
  REQUIRE(ui.model().scene().findings() != nullptr);
  REQUIRE(ui.model().scene().findings()->count(FindingKind::non_manifold_edge) > 0);
  const std::string kind = "inspect/" + std::to_string(static_cast<int>(FindingKind::non_manifold_edge));
  ui.click(kind);
  ui.click(kind + "/0");
  const MeshFinding& finding = ui.model().scene().findings()->of(FindingKind::non_manifold_edge)[0];
  CHECK(ui.model().view().inspection().marked.size() >= 3);
  CHECK(glm::length(ui.model().view().camera.target - (ui.model().scene().current()->mesh().origin() + finding.place)) <
        1e-12);
  ui.click("inspect/isolate");
  REQUIRE(ui.model().view().isolation != nullptr);
  std::size_t kept = 0;
  for (const std::uint8_t k : ui.model().view().isolation->kept) kept += k;
  CHECK(kept >= ui.model().view().inspection().marked.size());
  CHECK(kept < ui.model().scene().current()->mesh().triangle_count() / 2);
  ui.click("inspect/isolate_part");
  std::size_t part = 0;
  for (const std::uint8_t k : ui.model().view().isolation->kept) part += k;
  CHECK(part > kept);
  ui.click("inspect/show_all");
  CHECK(ui.model().view().isolation == nullptr);
  CHECK(ui.model().view().inspection().marked.empty());
}

TEST_CASE("the crease angle is live: the mesh is built anew, the view and the picked triangle stay") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh_options.normals = NormalSource::computed;
  RunningApp ui(options, 1280.0f, 2400.0f);
  ui.run(50);
  REQUIRE(ui.model().scene().audit()->crease_edges == 0);
  ui.drag("view", {40.0f, 10.0f});
  const Camera camera = ui.model().view().camera;
  ui.model().view().picked_triangle = 3;
  ui.click("inspect/crease");
  ui.frame();
  ui.type("2");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().scene().crease_angle_rad() == doctest::Approx(2.0 * kDegree));
  CHECK(ui.model().scene().audit()->crease_edges == ui.model().scene().audit()->edges);
  CHECK(ui.model().view().camera == camera);
  CHECK(ui.model().view().picked_triangle == 3);
  ui.run(50);
  CHECK(ui.model().time().tick().problem().empty());
}

TEST_CASE("a slice cuts the picture open and lets the pointer through") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  ui.frame();
  ui.click("inspect/slice");
  ui.click("inspect/slice/across the view");
  REQUIRE(ui.model().view().slice.has_value());
  const auto& scene = *ui.model().scene().current();
  const Camera& camera = ui.model().view().camera;
  const auto whole = pick_triangle(scene, camera, Vec2(200, 150), 400, 300);
  const auto cut = pick_triangle(scene, camera, Vec2(200, 150), 400, 300, ui.model().view().slice);
  REQUIRE(whole);
  REQUIRE(cut);
  CHECK(cut.distance_m > whole.distance_m + 0.05);  // the far wall, seen from inside
  ui.click("inspect/slice_flip");
  CHECK(pick_triangle(scene, camera, Vec2(200, 150), 400, 300, ui.model().view().slice).triangle == whole.triangle);
  const double at = ui.model().view().slice->offset_m;
  ui.drag("inspect/slice_at", {15.0f, 0.0f});
  CHECK(ui.model().view().slice->offset_m > at);
}

TEST_CASE(
    "a file in metres, taken for millimetres, is warned of - its unit and its longest side are chosen in the window") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh =
      folder.write("small.obj", "v 0 0 0\nv 0.06 0 0\nv 0 0.06 0\nv 0 0 0.06\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  HeadlessApp ui(options, 1280.0f, 2400.0f);
  const auto longest_mm = [&] {
    const Vec3 size = ui.model().scene().current()->mesh().bounds().size();
    return 1e3 * std::max({size.x, size.y, size.z});
  };
  const auto warnings = [&] {
    const auto& all = ui.model().messages().all();
    return std::count_if(all.begin(), all.end(),
                         [](const auto& m) { return testing::contains(m.text, "Unit of the file"); });
  };
  ui.frames(3);
  CHECK(longest_mm() == doctest::Approx(0.06));
  CHECK(warnings() == 1);
  for (const char* title : {"Iterations", "Smoothness as felt", "Map"})
    ui.model().window().open_sections()[title] = false;
  ui.model().window().open_sections()["Mesh"] = true;
  ui.frames(2);
  ui.click("mesh/unit");
  ui.click("mesh/unit/m");
  CHECK(longest_mm() == doctest::Approx(60.0));
  CHECK(warnings() == 1);
  const auto type_side = [&](const char* text) {
    ui.click("mesh/fit_mm");
    ui.type(text);
    ui.key(HeadlessApp::kEnter);
    ui.frames(2);
  };
  type_side("80");
  CHECK(longest_mm() == doctest::Approx(80.0));
  type_side("-3");
  CHECK(longest_mm() == doctest::Approx(80.0));
  type_side("0");
  CHECK(longest_mm() == doctest::Approx(60.0));
}

TEST_CASE("a slice across the view, chosen again, is across the view as it is now") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  ui.frame();
  const auto choose = [&] {
    ui.click("inspect/slice");
    ui.click("inspect/slice/across the view");
    REQUIRE(ui.model().view().slice.has_value());
    return glm::dot(ui.model().view().slice->normal, ui.model().view().camera.forward());
  };
  CHECK(choose() == doctest::Approx(-1.0));
  ui.model().view().camera.orbit(0.8, 0.2);
  CHECK(glm::dot(ui.model().view().slice->normal, ui.model().view().camera.forward()) > -0.95);
  CHECK(choose() == doctest::Approx(-1.0));
}

TEST_CASE("the slice's choice says what the plane is, whoever set it") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  const auto rest_of_row = [&] {
    ui.frames(2);
    return ui.app().items().find("inspect/slice_at") != nullptr;
  };
  CHECK(slice_choice(std::nullopt) == "no slice");
  CHECK_FALSE(rest_of_row());
  ui.model().view().slice = SlicePlane{{0.0, -1.0, 0.0}, 0.001};
  CHECK(rest_of_row());
  CHECK(slice_choice(ui.model().view().slice) == "across y");
  ui.click("inspect/slice_flip");
  CHECK(slice_choice(ui.model().view().slice) == "across y");
  ui.model().view().slice = SlicePlane{glm::normalize(Vec3(1.0, 2.0, 0.5)), 0.0};
  CHECK(slice_choice(ui.model().view().slice) == "across the view");
  ui.click("inspect/slice");
  ui.click("inspect/slice/across x");
  CHECK(slice_choice(ui.model().view().slice) == "across x");
  ui.click("inspect/slice");
  ui.click("inspect/slice/no slice");
  CHECK_FALSE(rest_of_row());
}

TEST_CASE("the picked triangle's control net can be copied with every digit") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 3000.0f);
  ui.model().view().picked_triangle = 7;
  ui.frame();
  ui.click("mesh/copy_net");
  const std::string text = ImGui::GetClipboardText();
  CHECK(text.find("b111,") != std::string::npos);
  CHECK(text.find("n101,") != std::string::npos);
  const Vec3 corner =
      ui.model().scene().current()->mesh().origin() + ui.model().scene().current()->mesh().position(7, 0);
  double x = 0, y = 0, z = 0;
  REQUIRE(std::sscanf(text.c_str() + text.find("b300,"), "b300,%lf,%lf,%lf", &x, &y, &z) == 3);
  CHECK(glm::length(Vec3(x, y, z) - corner) < 1e-16);
}
