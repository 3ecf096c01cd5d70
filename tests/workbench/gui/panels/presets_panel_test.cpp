// Preset files, read and written in the panel.
#include "tests/workbench/gui/running_app.h"

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace tangent;
using tangent::test::fresh_folder;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

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
