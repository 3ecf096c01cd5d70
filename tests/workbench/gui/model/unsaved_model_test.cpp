#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <functional>

#include <sys/wait.h>
#include <unistd.h>

using namespace tangent;
using namespace tangent::test;
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

/// Ends a window by SIGKILL, in a process of its own, after `what` and the moment in which its work is kept.
void kill_window(const AppOptions& options, const std::function<void(RunningApp&)>& what) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    RunningApp ui(options);
    what(ui);
    ui.frames(130);  // more than two seconds
    ::kill(::getpid(), SIGKILL);
    ::_exit(1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  REQUIRE(WTERMSIG(status) == SIGKILL);
}

}  // namespace

TEST_CASE(
    "a recording that was looked at when the window was killed is offered, and opens at its tick with its marks") {
  const testing::TempFolder folder;
  const std::string path = folder.file("run.sqlite");
  {
    RunningApp live;
    live.run(1500);
    live.model().record().write_history(path);
  }
  kill_window(kept_in(folder), [&path](RunningApp& ui) {
    ui.model().open(path);
    ui.frames(2);
    ui.model().time().select_tick(700);
    ui.model().time().add_bookmark();
    ui.model().time().bookmarks().set_note(ui.model().time().bookmarks().after(699)->id, "strange");
    ui.model().presets().set_value(stiffness(), 1234.5);
    ui.model().time().select_tick(987);
  });
  {
    RunningApp ui(kept_in(folder));
    ui.frame();
    CHECK(ui.model().unsaved().offer().find("the recording run.sqlite at tick 987") != std::string::npos);
    CHECK(ui.model().time().recording() == nullptr);
    ui.click("unsaved/take_up");
    ui.frames(2);
    REQUIRE(ui.model().time().recording() != nullptr);
    CHECK(ui.model().time().tick().record()->tick.tick == 987);
    const Bookmark* mark = ui.model().time().bookmarks().after(600);
    REQUIRE(mark != nullptr);
    CHECK(mark->tick == 700);
    CHECK(mark->note == "strange");
    CHECK(ui.model().presets().current().force.stiffness_n_per_m == 1234.5);
    CHECK(ui.model().unsaved().offer().empty());
    ui.model().time().go_live();
    ui.model().presets().revert_all();
  }
  // Closed in order, with a recording open: there is nothing to offer.
  {
    RunningApp ui(kept_in(folder));
    ui.run(100);
    ui.model().open(path);
    ui.frames(130);
    ui.model().presets().revert_all();
  }
  RunningApp ui(kept_in(folder));
  ui.frame();
  CHECK(ui.model().unsaved().offer().find("recording") == std::string::npos);
}

TEST_CASE("a recording that was being made when the window was killed is offered, and opens at its end") {
  const testing::TempFolder folder;
  const std::string path = folder.file("made.sqlite");
  kill_window(kept_in(folder), [&path](RunningApp& ui) {
    ui.model().record().start(path);
    ui.run(800);
    ui.frames(3);
  });
  RunningApp ui(kept_in(folder));
  ui.frame();
  CHECK(ui.model().unsaved().offer().find("being made, made.sqlite") != std::string::npos);
  ui.click("unsaved/take_up");
  ui.frames(2);
  REQUIRE(ui.model().time().recording() != nullptr);
  CHECK_FALSE(ui.model().time().recording()->info().closed);
  CHECK(ui.model().time().tick().record()->tick.tick == 799);
}

TEST_CASE("a recording that is gone since is not offered") {
  const testing::TempFolder folder;
  const std::string path = folder.file("gone.sqlite");
  kill_window(kept_in(folder), [&path](RunningApp& ui) {
    ui.model().record().start(path);
    ui.run(300);
  });
  for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(path + ending);
  RunningApp ui(kept_in(folder));
  ui.frame();
  CHECK(ui.model().unsaved().offer().empty());
  CHECK_FALSE(std::filesystem::exists(folder.path() / "unsaved" / "1.toml"));
}

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
  CHECK(read_window_settings(folder.path() / "window.toml")->text_size == approx(1.5));
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
