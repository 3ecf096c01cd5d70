#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

#include <doctest/doctest.h>

#include <filesystem>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

const PresetKey& stiffness() { return *find_preset_key("force", "stiffness_n_per_m"); }

AppOptions kept_in(const testing::TempFolder& folder) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.settings = folder.path() / "window.toml";
  return options;
}

/// As a crash leaves it: a file, and a lock that nobody holds.
void crash_in(const testing::TempFolder& folder) {
  const auto left = folder.path() / "left.toml";
  {
    RunningApp ui(kept_in(folder));
    ui.run(500);
    ui.model().presets().set_value(stiffness(), 1000.0);
    ui.model().presets().set_value(stiffness(), 1234.5);
    ui.model().presets().toggle_ab();
    ui.model().time().add_bookmark();
    const auto id = ui.model().time().bookmarks().all().back().id;
    ui.model().time().bookmarks().set_note(id, "look here");
    ui.model().keep();
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "unsaved")) {
      if (entry.path().extension() == ".toml") std::filesystem::copy_file(entry.path(), left);
    }
  }
  REQUIRE(std::filesystem::exists(left));
  std::filesystem::remove_all(folder.path() / "unsaved");  // what was left when the window was closed
  std::filesystem::create_directories(folder.path() / "unsaved");
  std::filesystem::rename(left, folder.path() / "unsaved" / "1.toml");
}

}  // namespace

TEST_CASE("after a crash preset edits with their undo and bookmarks with notes are offered, and taken up on a click") {
  const testing::TempFolder folder;
  crash_in(folder);
  RunningApp ui(kept_in(folder));
  ui.run(100);
  CHECK(ui.model().unsaved().offer().find("3 changes of presets and 1 bookmark") != std::string::npos);
  ui.click("unsaved/take_up");
  ui.frame();
  CHECK(ui.app().items().find("unsaved/take_up") == nullptr);
  CHECK(ui.model().presets().slots().active_slot() == 1);
  ui.model().presets().undo();
  CHECK(ui.model().presets().current().force.stiffness_n_per_m == 1234.5);
  CHECK(ui.model().presets().editor().changed());
  ui.model().presets().undo();
  CHECK(ui.model().presets().current().force.stiffness_n_per_m == 1000.0);
  const auto& marks = ui.model().time().bookmarks().all();
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].note == "earlier run: look here");
}

TEST_CASE(
    "work that is discarded is offered no more, and an orderly end with nothing changed leaves nothing to offer") {
  const testing::TempFolder folder;
  crash_in(folder);
  {
    RunningApp ui(kept_in(folder));
    ui.click("unsaved/discard");
    CHECK(ui.model().unsaved().offer().empty());
    ui.model().presets().set_value(stiffness(), 500.0);
    ui.model().keep();
    ui.model().presets().revert_all();
  }
  RunningApp ui(kept_in(folder));
  CHECK(ui.model().unsaved().offer().empty());
}

TEST_CASE("settings that can't be written are tried again, the reason is said once, and unread work is named") {
  const testing::TempFolder folder;
  std::filesystem::create_directories(folder.path() / "unsaved");
  folder.write("unsaved/77.toml", "at = = 1\n");
  HeadlessApp ui(kept_in(folder));
  const auto said = [&](const char* text) {
    std::size_t n = 0;
    for (const Message& m : ui.model().messages().all()) n += testing::contains(m.text, text) ? m.times : 0;
    return n;
  };
  CHECK(said("77.toml.bad") == 1);
  folder.write("window.toml", "format = 2\n");
  ui.model().window().set_ui_scale(1.5f);
  for (int i = 0; i < 3; ++i) ui.model().window().keep_settings({});
  CHECK(testing::read_text(folder.path() / "window.toml") == "format = 2\n");
  CHECK(said("this file has format 2") == 1);
  std::filesystem::remove(folder.path() / "window.toml");
  ui.model().window().keep_settings({});
  CHECK(read_window_settings(folder.path() / "window.toml")->text_size == doctest::Approx(1.5));
}

TEST_CASE("a window that is closed with changes in no file leaves them to the next one, and nothing else") {
  const testing::TempFolder folder;
  {
    RunningApp ui(kept_in(folder));
    ui.run(100);
    ui.model().presets().set_value(stiffness(), 1000.0);
  }
  {
    RunningApp ui(kept_in(folder));
    ui.run(100);
    CHECK(ui.model().unsaved().offer().find("1 change of presets") != std::string::npos);
    ui.click("unsaved/take_up");
    CHECK(ui.model().presets().current().force.stiffness_n_per_m == 1000.0);
    ui.model().presets().revert_all();
  }
  RunningApp ui(kept_in(folder));
  ui.run(100);
  CHECK(ui.model().unsaved().offer().empty());
}
