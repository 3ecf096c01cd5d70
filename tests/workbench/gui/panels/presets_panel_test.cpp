// Preset files, read and written in the panel.
#include "core/lab/audit/finger_size.h"
#include "tests/support/paths.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/panels/panels.h"

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

TEST_CASE("a saved preset says where its values come from") {
  const auto folder = fresh_folder("tangent_app_origin");
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder;
  RunningApp ui(options, 1280.0f, 2000.0f);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.4);
  ui.run(2000);
  ui.click("presets/note");
  ui.type("for the rim");
  ui.click("presets/name");
  ui.type("mine");
  ui.click("presets/save");
  const auto saved = read_preset(folder / "mine.toml");
  REQUIRE(saved);
  const PresetAbout& about = saved->about;
  CHECK(about.note == "for the rim");
  CHECK(about.program_version == TANGENT_VERSION);
  CHECK(about.mesh_name == ui.model().mesh()->name());
  CHECK(about.metres_per_unit == ui.model().scene().metres_per_unit());
  CHECK(about.longest_side_m == longest_side_m(*ui.model().mesh()));
  REQUIRE(about.also_measured.size() == 6);
  CHECK(about.also_measured[1].first == "ticks");
  CHECK(std::get<double>(about.also_measured[1].second) > 500.0);
  CHECK(about.also_measured[2].first == "mean_iterations");
  CHECK(std::get<double>(about.also_measured[2].second) >= 1.0);
  CHECK(read_preset(folder / "mine.toml")->about == about);
}

TEST_CASE("a preset that was saved on another mesh or size says so when it is loaded") {
  const auto folder = fresh_folder("tangent_app_other_mesh");
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder;
  RunningApp ui(options);
  ui.run(50);
  PresetFile file;
  file.about.mesh_name = "bracket.obj";
  file.about.mesh_hash = "0123456789abcdef";
  REQUIRE(write_preset(file, folder / "other.toml"));
  file.about.longest_side_m = 1.5;
  REQUIRE(write_preset(file, folder / "larger.toml"));
  ui.model().open((folder / "other.toml").string());
  CHECK(said(ui.model(), Severity::warning, "saved on bracket.obj"));
  CHECK_FALSE(said(ui.model(), Severity::warning, "1500 mm"));
  ui.model().open((folder / "larger.toml").string());
  CHECK(said(ui.model(), Severity::warning, "bracket.obj of 1500 mm"));
}

TEST_CASE("the program's own values can be chosen again, and undone") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = fresh_folder("tangent_app_built_in");
  RunningApp ui(options, 1280.0f, 2000.0f);
  ui.model().presets().load(std::filesystem::path(testing::source_folder() + "/presets") / "default.toml");
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.4);
  ui.frame();
  ui.click("presets/built_in");
  CHECK(ui.model().presets().current() == Preset{});
  CHECK(ui.model().presets().editor().name() == "built-in");
  CHECK(ui.model().presets().editor().path().empty());
  ui.model().presets().undo();
  CHECK(ui.model().presets().current().solver.gain_overall == 0.4);
}

TEST_CASE("presets that ship are listed beside a person's own, which keep their names") {
  const auto folder = fresh_folder("tangent_app_own");
  REQUIRE(write_preset({}, folder / "default.toml"));
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder;
  RunningApp ui(options, 1280.0f, 2000.0f);
  ui.frame();
  CHECK(ui.app().items().find("presets/file/default") != nullptr);
  REQUIRE(ui.app().items().find("presets/file/default (shipped)") != nullptr);
  ui.click("presets/file/default (shipped)");
  CHECK(ui.model().presets().editor().path().parent_path() ==
        std::filesystem::path(testing::source_folder() + "/presets"));
}

TEST_CASE("saving B leaves A its name and what it was loaded from") {
  const auto folder = fresh_folder("tangent_app_save_b");
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder;
  RunningApp ui(options);
  PresetModel& presets = ui.model().presets();
  const PresetKey& gain = *find_preset_key("solver", "gain_overall");
  presets.load(std::filesystem::path(testing::source_folder() + "/presets") / "default.toml");
  presets.copy_ab();
  presets.toggle_ab();
  presets.set_value(gain, 0.4);
  REQUIRE(presets.save("mine", {}));
  CHECK(presets.slots().slot(1).name() == "mine");
  CHECK(presets.slots().slot(0).name() == "default");
  CHECK_FALSE(presets.slots().slot(0).changed());
  presets.toggle_ab();
  CHECK(presets.editor().changes().empty());
}

TEST_CASE("saving with ticks selected attaches them as evidence, which holds until a value is edited in the file") {
  const auto folder = fresh_folder("tangent_app_evidence");
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "icosphere";
  options.preset_folder = folder;
  RunningApp ui(options, 1280.0f, 2000.0f);
  ui.run(1500);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.9);
  ui.model().time().select_tick(200);
  ui.frame();
  ui.click("plots/cursor_a");
  ui.model().time().select_tick(599);
  ui.frame();
  ui.click("plots/cursor_b");
  ui.click("presets/name");
  ui.type("mine");
  ui.click("presets/save");
  ui.frames(2);
  CHECK(said(ui.model(), Severity::note, "names its evidence: 400 ticks"));
  CHECK(std::filesystem::exists(folder / "mine.poses.csv"));
  const auto saved = read_preset(folder / "mine.toml");
  REQUIRE(saved);
  REQUIRE(saved->about.measured.has_value());
  CHECK(saved->about.measured->mesh.source == "make icosphere");
  CHECK(saved->about.measured->motion.file == "mine.poses.csv");
  CHECK(saved->about.measured->numbers.ticks == 400.0);
  CHECK(saved->about == ui.model().presets().editor().loaded().about);
  CHECK(ui.model().evidence().label() == "holds");
  PresetFile edited = *saved;
  edited.preset.solver.gain_overall = 0.8;
  REQUIRE(write_preset(edited, folder / "mine.toml"));
  ui.model().presets().load(folder / "mine.toml");
  ui.frame();
  CHECK(ui.model().evidence().label().empty());  // in simulated time only when asked
  ui.click("presets/check");
  ui.frames(2);
  CHECK(ui.model().evidence().label() == "changed");
  REQUIRE(ui.model().evidence().result() != nullptr);
  CHECK(ui.model().evidence().result()->differences.front().what == "solver.gain_overall");
  ui.click("presets/attach");
  REQUIRE(save_preset(ui.model(), "other", ""));
  CHECK(std::filesystem::exists(folder / "other.toml"));
  CHECK_FALSE(std::filesystem::exists(folder / "other.poses.csv"));
}
