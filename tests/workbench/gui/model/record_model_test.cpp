// Recordings that the window makes.
#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/recording/recording.h"
#include "workbench/recording/replay.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

namespace {

AppOptions options_in(const testing::TempFolder& folder) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.screenshots = folder.file("");
  return options;
}

RecordingInfo info_of(const std::filesystem::path& path) {
  auto recording = Recording::open(path);
  REQUIRE_MESSAGE(recording, (recording ? "" : recording.error().message()));
  return recording->info();
}

/// Every tick again, to the bit.
void check_replays(const std::filesystem::path& path) {
  const auto report = replay(path);
  REQUIRE_MESSAGE(report, (report ? "" : report.error().message()));
  CHECK(report->same());
}

std::size_t events_of_kind(const std::filesystem::path& path, const std::string& kind) {
  auto recording = Recording::open(path);
  REQUIRE(recording);
  const auto events = recording->events();
  REQUIRE(events);
  return static_cast<std::size_t>(
      std::count_if(events->begin(), events->end(), [&](const auto& event) { return event.kind == kind; }));
}

}  // namespace

TEST_CASE("the red button and its key record from now on, and again ends it") {
  const testing::TempFolder folder;
  RunningApp ui(options_in(folder));
  ui.run(300);
  ui.click("transport/record");
  REQUIRE(ui.model().record().recording());
  const std::filesystem::path first = ui.model().record().file();
  CHECK(first.parent_path() == std::filesystem::path(folder.file("x")).parent_path());
  ui.app().advance(500);
  ui.key('R');
  CHECK_FALSE(ui.model().record().recording());
  CHECK(info_of(first).ticks == 500);
  CHECK(info_of(first).first_tick == 300);
  CHECK(info_of(first).closed);
  check_replays(first);
  // A second one at the same second of the day has a name of its own.
  ui.key('R');
  CHECK(ui.model().record().file() != first);
  ui.app().advance(10);
  ui.key('R');
  CHECK(info_of(ui.model().record().file()).ticks == 10);
}

TEST_CASE("the history and a selection are recorded as they were, with bookmarks, presets and what the gate did") {
  const testing::TempFolder folder;
  RunningApp ui(options_in(folder));
  ui.run(700);
  ui.model().presets().set_value(*find_preset_key("force", "stiffness_n_per_m"), 250.0);
  ui.run(1500);
  Bookmarks& marks = ui.model().time().live_bookmarks();
  marks.set_note(marks.add(800, 0.8), "here");
  ui.model().record().write_history(folder.file("all.sqlite"));
  CHECK(info_of(folder.file("all.sqlite")).ticks == 2200);
  check_replays(folder.file("all.sqlite"));
  CHECK(events_of_kind(folder.file("all.sqlite"), "preset") == 1);
  CHECK(events_of_kind(folder.file("all.sqlite"), "bookmark") == 1);
  CHECK(events_of_kind(folder.file("all.sqlite"), "state") > 0);
  ui.model().record().write_selection();
  CHECK(said(ui.model(), Severity::note, "set cursors A and B first"));
  ui.model().time().set_selection(TickRange{1000, 1400});
  ui.model().record().write_selection(folder.file("part.sqlite"));
  CHECK(info_of(folder.file("part.sqlite")).ticks == 401);
  CHECK(info_of(folder.file("part.sqlite")).first_tick == 1000);
  CHECK(events_of_kind(folder.file("part.sqlite"), "bookmark") == 0);
  check_replays(folder.file("part.sqlite"));
}

TEST_CASE("another mesh while it is recorded is in the recording") {
  const testing::TempFolder folder;
  RunningApp ui(options_in(folder));
  ui.model().record().start(folder.file("two.sqlite"));
  ui.run(400);
  ui.model().open("cube");
  ui.app().advance(400);
  ui.frame();
  ui.model().record().stop();
  auto recording = Recording::open(folder.file("two.sqlite"));
  REQUIRE(recording);
  REQUIRE(recording->scenes().size() == 2);
  CHECK(recording->scenes()[0].has_bytes);
  CHECK(recording->scenes()[1].has_bytes);
  check_replays(folder.file("two.sqlite"));
}

TEST_CASE("a file that is there, and a folder that is not, are errors, and nothing is recorded") {
  const testing::TempFolder folder;
  RunningApp ui(options_in(folder));
  ui.run(100);
  for (auto record : {&RecordModel::start, &RecordModel::write_history}) {
    ui.model().messages().clear();
    (ui.model().record().*record)(folder.file("none/x.sqlite"));
    CHECK(said(ui.model(), Severity::error, "can't be created"));
    CHECK_FALSE(ui.model().record().recording());
  }
  ui.model().record().write_history(folder.file("there.sqlite"));
  ui.model().record().start(folder.file("there.sqlite"));
  CHECK(said(ui.model(), Severity::error, "never written over"));
  CHECK(info_of(folder.file("there.sqlite")).ticks == 100);
}

TEST_CASE("a file that vanishes is said, the servo goes on, and so does the window") {
  const testing::TempFolder folder;
  RunningApp ui(options_in(folder));
  ui.model().record().start(folder.file("gone.sqlite"));
  ui.run(300);
  std::filesystem::remove(folder.file("gone.sqlite"));
  ui.app().advance(300);
  ui.frames(2);
  CHECK(said(ui.model(), Severity::error, "is gone"));
  CHECK(ui.model().record().recording());
  CHECK(ui.app().items().find("recording/trouble") != nullptr);
  const std::uint64_t before = ui.model().time().end_tick();
  ui.app().advance(300);
  ui.frame();
  CHECK(ui.model().time().end_tick() == before + 300);
  ui.model().messages().clear();
  ui.model().record().stop();
  CHECK(said(ui.model(), Severity::error, "is gone"));
}

TEST_CASE(
    "where the disk is full, the window says so as long as it is, the servo goes on, and what is written is read") {
  const testing::TempFolder folder;
  const std::string path = folder.file("full.sqlite");
  RunningApp ui(options_in(folder));
  ui.model().record().start(path);
  ui.run(1000);
  CHECK(ui.app().items().find("status/not_recorded") == nullptr);
  {
    const testing::FullDisk full(path);
    ui.app().advance(4000);
    ui.frames(2);
    CHECK(said(ui.model(), Severity::error, "not recorded at present"));
    CHECK(ui.app().items().find("recording/trouble") != nullptr);
    CHECK(ui.app().items().find("status/not_recorded") != nullptr);
    ui.frames(60);
    CHECK(ui.app().items().find("status/not_recorded") != nullptr);
    ui.app().advance(500);
    ui.frame();
    CHECK(ui.model().time().end_tick() == 5500);
    CHECK(ui.model().devices().status().servo.running);
    CHECK(info_of(path).ticks == 1000);
    CHECK_FALSE(info_of(path).closed);
  }
  ui.model().record().stop();
  CHECK(ui.model().record().status().missing == 0);
  CHECK(info_of(path).ticks == 5500);
  check_replays(path);
  // It is an event of the file, and a mark where it is opened.
  CHECK(events_of_kind(path, "recorder") > 0);
  ui.model().open(path);
  ui.frames(2);
  REQUIRE(ui.model().time().recording() != nullptr);
  const auto& marks = ui.model().time().bookmarks().all();
  CHECK(
      std::any_of(marks.begin(), marks.end(), [](const Bookmark& m) { return m.kind == BookmarkKind::device_fault; }));
}

TEST_CASE("a history that does not fit on the disk is an error, and leaves no file") {
  const testing::TempFolder folder;
  RunningApp ui(options_in(folder));
  ui.run(3000);
  folder.write("small.sqlite-wal", "");
  {
    const testing::FullDisk full(folder.file("small.sqlite"));
    ui.model().record().write_history(folder.file("history.sqlite"));
  }
  CHECK(said(ui.model(), Severity::error, "not recorded"));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("buttons that record without a name write into the window's folder, and a test's run leaves nothing behind") {
  const auto entries = [](const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names.insert(entry.path().filename().string());
    return names;
  };
  const testing::TempFolder here;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(here.path());
  std::filesystem::path own;
  {
    RunningApp ui(HeadlessApp::deterministic_options(), 1600.0f, 4200.0f);
    own = ui.folder();
    ui.run(300);
    ui.click("transport/record");
    ui.app().advance(100);
    ui.click("transport/record");
    ui.click("recording/history");
    ui.model().time().set_selection(TickRange{100, 200});
    ui.model().record().write_selection();
    ui.key('R');
    ui.app().advance(10);
    ui.frame();
    CHECK(entries(own).size() >= 4);  // the last one is still being written
  }
  CHECK_FALSE(std::filesystem::exists(own));
  CHECK(entries(here.path()).empty());
  std::filesystem::current_path(before);
}

TEST_CASE("a window that is told to record does so from its first session on, and closes the file with it") {
  const testing::TempFolder folder;
  AppOptions options = options_in(folder);
  options.record = folder.file("told.sqlite");
  {
    RunningApp ui(options);
    CHECK(ui.model().record().recording());
    ui.run(600);
  }
  CHECK(info_of(folder.file("told.sqlite")).closed);
  CHECK(info_of(folder.file("told.sqlite")).ticks == 600);
  check_replays(folder.file("told.sqlite"));
}

TEST_CASE("other devices end the recording, whole, before the session that it is of") {
  const testing::TempFolder folder;
  RunningApp ui(options_in(folder));
  ui.model().record().start(folder.file("a.sqlite"));
  ui.run(200);
  ui.model().devices().choose({"none", ui.model().devices().names().display});
  CHECK_FALSE(ui.model().record().recording());
  CHECK(info_of(folder.file("a.sqlite")).ticks == 200);
  ui.model().record().start(folder.file("b.sqlite"));
  ui.app().advance(100);
  ui.frame();
  ui.model().record().stop();
  auto recording = Recording::open(folder.file("b.sqlite"));
  REQUIRE(recording);
  REQUIRE(recording->scenes().size() == 1);
  CHECK(recording->scenes()[0].has_bytes);
}
