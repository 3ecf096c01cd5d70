// What is not known to be safe does not reach an armed device before a person says yes, whoever changes the preset.
#include "workbench/gui/model/guard_model.h"
#include "tests/support/paths.h"
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/panels/commands.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

const PresetKey& stiffness() { return *find_preset_key("force.stiffness_n_per_m"); }

/// The ideal device, without friction, armed on 300 N/m with the range of its stiffness swept.
struct Guarded {
  HeadlessApp ui;
  MenuBar menu;  ///< where commands leave their wishes
  static AppOptions options() {
    AppOptions options = HeadlessApp::deterministic_options();
    options.mesh = "torus";
    options.devices = {"ideal", "none"};
    return options;
  }
  explicit Guarded(bool sweep = true) : ui(options()) {
    model().presets().set_value(stiffness(), 300.0);
    ui.app().advance(1500);
    ui.frames(2);
    REQUIRE_FALSE(model().devices().stopped());
    if (!sweep) return;
    guard().find_ranges({&stiffness()});
    ui.frames(2);
  }
  AppModel& model() { return ui.model(); }
  GuardModel& guard() { return model().guard(); }
  double on_device() { return model().devices().session()->preset().force.stiffness_n_per_m; }
  double in_panel() { return model().presets().current().force.stiffness_n_per_m; }
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("inside the safe range a value goes to the armed device, outside it waits for a yes, and Enter is no") {
  Guarded g;
  const SafeRange range = g.guard().range(stiffness());
  REQUIRE(!range.samples().empty());
  CHECK(g.guard().guards());
  REQUIRE(range.at(320.0) == Safety::stable);
  REQUIRE(range.at(3400.0) != Safety::stable);
  g.model().presets().slide_value(stiffness(), 320.0);
  CHECK_FALSE(g.guard().question());
  CHECK(g.on_device() == 320.0);
  g.ui.frames(2);  // swept again around it
  g.model().presets().type_value(stiffness(), "3400");
  g.ui.frames(2);
  REQUIRE(g.guard().question());
  CHECK(g.in_panel() == 3400.0);
  CHECK(g.on_device() == 320.0);
  g.ui.key(HeadlessApp::kEnter);
  CHECK_FALSE(g.guard().question());
  CHECK(g.in_panel() == 320.0);
  CHECK(g.on_device() == 320.0);
  g.model().presets().type_value(stiffness(), "3400");
  g.ui.frames(2);
  g.ui.click("guard/yes");
  CHECK(g.on_device() == 3400.0);
  CHECK_FALSE(g.guard().question());
}

TEST_CASE("no path leads around the question: values, undo, A and B, files, built-in values, conditions, gains") {
  Guarded g;
  PresetModel& presets = g.model().presets();
  const auto file = std::filesystem::temp_directory_path() / "tangent_guard_stiff.toml";
  std::ofstream(file) << "format = 2\n[force]\nstiffness_n_per_m = 3400\n";
  struct Path {
    const char* name;
    std::function<void()> take;
  };
  const std::vector<Path> paths{
      {"set", [&] { presets.set_value(stiffness(), 3400.0); }},
      {"slide", [&] { presets.slide_value(stiffness(), 3400.0); }},
      {"type", [&] { presets.type_value(stiffness(), "3400"); }},
      {"several",
       [&] {
         presets.set_values("both", std::vector{std::pair{&stiffness(), 3400.0}});
       }},
      {"reset", [&] { presets.reset_value(stiffness()); }},
      {"revert", [&] { presets.revert_all(); }},
      {"load", [&] { presets.load(file); }},
      {"open", [&] { g.model().open(file.string()); }},
      {"built-in", [&] { presets.load_built_in(); }},
      {"recorded", [&] { presets.take_recorded(Preset{}, "a recording"); }},
      {"undo", [&] { presets.undo(); }},
      {"redo", [&] { presets.redo(); }},
      {"A and B", [&] { presets.toggle_ab(); }},
  };
  for (const Path& path : paths) {
    INFO("path ", std::string(path.name));
    if (std::string(path.name) == "undo") {  // a refused value is a step of it
      presets.set_value(stiffness(), 3400.0);
      g.guard().answer(false);
    }
    path.take();
    g.ui.frames(1);
    CHECK(g.on_device() == 300.0);
    if (g.in_panel() == 300.0) continue;  // the path led nowhere else
    CHECK(g.guard().question());
    g.guard().answer(false);
    CHECK(g.in_panel() == 300.0);
  }
  std::filesystem::remove(file);
}

TEST_CASE("only one line of the window sends a preset to a session, and only the guard's way leads there") {
  const std::filesystem::path source = std::filesystem::path(testing::source_folder()) / "workbench";
  int sets = 0, sends = 0;
  for (const char* room : {"gui", "cli", "recording", "report", "evidence"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / room)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = text_of(entry.path());
      for (std::size_t at = 0; (at = text.find("->set_preset(", at)) != std::string::npos; ++at) ++sets;
      for (std::size_t at = 0; (at = text.find(".set_preset(", at)) != std::string::npos; ++at) ++sets;
      for (std::size_t at = 0; (at = text.find("devices_.send_preset(", at)) != std::string::npos; ++at) ++sends;
    }
  CHECK(sets == 1);   // DeviceModel::send_preset
  CHECK(sends == 1);  // AppModel::send_preset, after GuardModel::lets_through
}

TEST_CASE("disarmed, switched off, or never swept on a simulated device, nothing is asked") {
  for (const int what : {0, 1, 2}) {
    CAPTURE(what);
    Guarded g(what != 2);
    if (what == 0) {
      g.model().devices().stop();
      g.ui.app().advance(20);
      g.ui.frames(2);
    }
    if (what == 1) g.guard().on = false;
    g.model().presets().set_value(stiffness(), 3400.0);
    g.ui.frames(1);
    CHECK_FALSE(g.guard().question());
    CHECK(g.on_device() == 3400.0);
  }
}

TEST_CASE("a change that is held goes through when the device is disarmed, and one outside the loop is never held") {
  Guarded g;
  g.model().presets().set_value(*find_preset_key("display.travel_m"), 12e-3);
  CHECK_FALSE(g.guard().question());
  g.model().presets().set_value(stiffness(), 3400.0);
  REQUIRE(g.guard().question());
  g.model().devices().stop();
  g.ui.app().advance(20);
  g.ui.frames(2);
  CHECK_FALSE(g.guard().question());
  CHECK(g.on_device() == 3400.0);
}

TEST_CASE("what the servo undid is said, is in the panel too, and is known to shake from then on") {
  Guarded g;
  g.model().presets().set_value(stiffness(), 340.0);
  g.ui.app().advance(50);
  g.model().devices().session()->inject({InjectedFault::noise, 5}, false);
  g.ui.app().advance(50);
  g.ui.frames(2);
  REQUIRE(g.model().devices().session()->preset_undone().count == 1);
  CHECK(g.in_panel() == 300.0);
  CHECK(g.on_device() == 300.0);
  bool said = false;
  for (const Message& message : g.model().messages().all())
    said = said || message.text.find("was undone at once: the safety gate stopped") != std::string::npos;
  CHECK(said);
  g.model().devices().arm();
  g.ui.app().advance(3000);
  g.ui.frames(2);
  REQUIRE_FALSE(g.model().devices().stopped());
  g.model().presets().set_value(stiffness(), 340.0);
  CHECK(g.guard().question());
}

TEST_CASE("what was never swept is asked about, whichever way it comes, and only a yes sends it") {
  const PresetKey& radius = *find_preset_key("finger.radius_m");
  Guarded g;
  PresetModel& presets = g.model().presets();
  const auto on_device = [&] { return g.model().devices().session()->preset().finger.radius_m; };
  const double before = on_device();
  const auto folder = std::filesystem::temp_directory_path();
  const auto file = folder / "tangent_guard_finger.toml", lines = folder / "tangent_guard_finger.txt";
  std::ofstream(file) << "format = 3\n[force]\nstiffness_n_per_m = 300\n[finger]\nradius_m = 0.03\n";
  std::ofstream(lines) << "finger radius 30 mm\n";
  struct Path {
    const char* name;
    std::function<void()> take;
  };
  const std::vector<Path> paths{
      {"slider", [&] { presets.slide_value(radius, 0.03); }},
      {"typed", [&] { presets.type_value(radius, "30 mm"); }},
      {"command", [&] { CHECK(run_line(window_commands(g.model(), g.menu), "finger radius 30 mm")); }},
      {"script", [&] { g.ui.app().run_script(lines); }},
      {"preset", [&] { presets.load(file); }},
      {"opened", [&] { g.model().open(file.string()); }},
      {"point of a plot",
       [&] {
         presets.set_values("a swept point", std::vector{std::pair{&radius, 0.03}});
       }},
      {"trial",
       [&] {
         presets.try_values("trial 1", std::vector{std::pair{&radius, 0.03}});
       }},
      {"A and B", [&] { presets.toggle_ab(); }},
      {"redo", [&] { presets.redo(); }},
  };
  for (const Path& path : paths) {
    CAPTURE(std::string(path.name));
    if (std::string(path.name) == "redo") presets.undo();
    path.take();
    g.ui.frames(8);
    CHECK(on_device() == before);
    if (presets.current().finger.radius_m == before) continue;
    REQUIRE(g.guard().question());
    CHECK(g.guard().question()->why.find("another finger") != std::string::npos);
    g.guard().answer(false);
    CHECK(presets.current().finger.radius_m == before);
    CHECK(on_device() == before);
  }
  // Tried meanwhile, so that something is known of it: another finger is asked about all the same.
  presets.set_value(radius, 0.03);
  CHECK(on_device() == before);
  REQUIRE(g.guard().question());
  g.guard().answer(true);
  CHECK(on_device() == 0.03);
  std::filesystem::remove(file);
  std::filesystem::remove(lines);
}

TEST_CASE("a value beside the swept line is tried in the simulated hand, and its outcome is said, not acted upon") {
  Guarded g;
  const PresetKey& damping = *find_preset_key("force.damping_n_s_per_m");
  g.model().presets().set_value(damping, 0.05);
  g.ui.frames(3);
  REQUIRE(g.guard().question());
  CHECK(g.guard().question()->tried);
  CHECK(g.guard().question()->why.find("is stable in the simulated hand") == 0);
  CHECK(g.model().devices().session()->preset().force.damping_n_s_per_m == 0.0);
  g.guard().answer(true);
  CHECK(g.model().devices().session()->preset().force.damping_n_s_per_m == 0.05);
}

TEST_CASE("paused while a change is asked about, the past is solved against what the devices have") {
  Guarded g;
  g.model().presets().set_value(stiffness(), 3400.0);
  REQUIRE(g.guard().question());
  TimeModel& time = g.model().time();
  time.set_paused(true);
  g.ui.frames(2);
  time.solve_past_again();
  REQUIRE(time.time_machine().compared() != nullptr);
  CHECK(time.time_machine().compared()->before.force.stiffness_n_per_m == 300.0);
  CHECK(time.time_machine().compared()->after.force.stiffness_n_per_m == 3400.0);
  CHECK(time.name_after() == "asked, not set");
  g.guard().answer(false);
  g.ui.frames(2);
  CHECK(time.time_machine().ghost() == nullptr);
  CHECK(time.time_machine().compared() == nullptr);
  time.solve_past_again();
  REQUIRE(time.time_machine().ghost() != nullptr);
  CHECK(time.time_machine().ghost()->preset.force.stiffness_n_per_m == 300.0);
  CHECK(time.name_after() == "now");
}

TEST_CASE("a switch of A and B that is refused leaves the values of both") {
  Guarded g;
  PresetModel& presets = g.model().presets();
  presets.try_values("trial 1", std::vector{std::pair{&stiffness(), 3400.0}});
  REQUIRE(g.guard().question());
  g.guard().answer(false);
  CHECK(presets.slots().active_slot() == 0);
  CHECK(g.in_panel() == 300.0);
  CHECK(presets.slots().slot(1).current().force.stiffness_n_per_m == 3400.0);
  presets.toggle_ab();
  REQUIRE(g.guard().question());
  g.guard().answer(false);
  CHECK(presets.slots().active_slot() == 0);
  CHECK(presets.slots().slot(1).current().force.stiffness_n_per_m == 3400.0);
}

TEST_CASE("who stops the search for safe ranges is guarded as before, and an answer needs a question") {
  Guarded g;
  g.guard().cancel();
  g.ui.frames(2);
  g.model().presets().set_value(stiffness(), 3400.0);
  REQUIRE(g.guard().question());
  CHECK(g.on_device() == 300.0);
  g.guard().answer(false);
  const std::uint64_t refused = g.model().messages().refusals();
  g.guard().answer(true);
  CHECK(g.model().messages().refusals() == refused + 1);
}
