// What is not known to be safe does not reach an armed device before a person says yes, whoever changes the preset.
#include "workbench/gui/model/guard_model.h"
#include "tests/workbench/gui/headless_app.h"

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
  const std::filesystem::path source = std::filesystem::path(TANGENT_SOURCE_DIR) / "workbench";
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
