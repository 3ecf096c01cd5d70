// Recordings that the window makes.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/recording/recording.h"
#include "workbench/recording/replay.h"

#include <filesystem>

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
