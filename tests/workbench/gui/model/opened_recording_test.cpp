// A recording in the window is looked at like the live past.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/plots/kept_bars.h"
#include "workbench/recording/recorded_stretch.h"
#include "workbench/recording/session_recorder.h"

#include <sqlite3.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <thread>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

namespace {

struct RecordedFile {
  testing::TempFolder folder;
  std::string path = folder.file("run.sqlite");
};

void change_file(const std::string& path, const std::string& sql) {
  sqlite3* connection = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &connection) == SQLITE_OK);
  const int code = sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr);
  const std::string why = sqlite3_errmsg(connection);
  sqlite3_close(connection);
  REQUIRE_MESSAGE(code == SQLITE_OK, sql << ": " << why);
}

std::string bytes_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What a window records of a torus: 3 s, with another preset after the first, and two bookmarks.
void record_torus(const std::string& path) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "torus";
  RunningApp ui(options);
  ui.app().advance(200);
  ui.model().record().start(path);
  REQUIRE(ui.model().record().recording());
  ui.app().advance(800);
  ui.frame();
  ui.model().presets().set_value(*find_preset_key("force", "stiffness_n_per_m"), 333.0);
  ui.app().advance(1000);
  ui.frame();
  ui.app().advance(1000);
  ui.frame();
  Bookmarks& marks = ui.model().time().live_bookmarks();
  marks.set_note(marks.add(1500, 1.5), "here it jumps");
  const std::uint32_t gone = marks.add(1600, 1.6);
  ui.frame();
  marks.remove(gone);
  ui.frame();
  ui.model().record().stop();
  REQUIRE(ui.model().record().status().written == 2800);
  REQUIRE(ui.model().record().status().missing == 0);
}

struct OpenedApp : RunningApp {
  explicit OpenedApp(const std::string& path, double history_s = 600.0) : RunningApp(options(history_s)) {
    model().open(path);
    frames(2);
  }
  static AppOptions options(double history_s) {
    AppOptions options = deterministic_options();
    options.history_s = history_s;
    return options;
  }
  TimeModel& time() { return model().time(); }
  std::uint64_t tick() { return time().tick().record()->tick.tick; }
};

}  // namespace

TEST_CASE("a recording made by the window opens in it: mesh, preset, marks, and every tick with its planes") {
  const RecordedFile file;
  record_torus(file.path);
  const std::string before = bytes_in(file.path);
  OpenedApp ui(file.path);
  REQUIRE(ui.time().recording() != nullptr);
  CHECK(ui.time().recording()->unsolvable().empty());
  CHECK(ui.time().recording()->remarks().empty());
  CHECK(ui.time().paused());
  CHECK(ui.time().first_tick() == 200);
  CHECK(ui.time().end_tick() == 3000);
  CHECK(ui.tick() == 200);
  CHECK(ui.model().scene().current()->mesh().name() == "torus");
  CHECK(ui.time().scene_of_tick() == ui.model().scene().current());
  for (std::uint64_t t = 200; t < 3000; t += 97) {
    ui.time().select_tick(t);
    REQUIRE(ui.tick() == t);
    REQUIRE_FALSE(ui.time().tick().iterations().empty());
    CHECK(ui.time().tick().iterations().back().error_m == ui.time().tick().record()->tick.output.error_m);
  }
  CHECK(ui.time().preset_of_tick()->force.stiffness_n_per_m == 333.0);
  REQUIRE(ui.time().parameter_marks().size() == 1);
  CHECK(ui.time().parameter_marks()[0].text.find("333") != std::string::npos);
  CHECK(ui.time().recording()->different() == 0);
  ui.time().select_tick(300);
  ui.key(']');
  CHECK(ui.tick() == 1500);
  REQUIRE(ui.time().bookmarks().after(1400) != nullptr);
  CHECK(ui.time().bookmarks().after(1400)->note == "here it jumps");
  std::size_t by_person = 0;
  for (const Bookmark& mark : ui.time().bookmarks().all()) by_person += mark.kind == BookmarkKind::user ? 1 : 0;
  CHECK(by_person == 1);
  // Looked at, not changed: also by a bookmark of one's own.
  ui.time().select_tick(2000);
  ui.time().add_bookmark();
  CHECK(ui.time().bookmarks().after(1999) != nullptr);
  CHECK(ui.time().live_bookmarks().after(1999) == nullptr);
  ui.key(HeadlessApp::kEnd);
  CHECK(ui.time().recording() == nullptr);
  CHECK_FALSE(ui.time().paused());
  CHECK(bytes_in(file.path) == before);
}

TEST_CASE("plots of a recording are those of the live run, sample by sample") {
  const RecordedFile file;
  testing::TempFolder other;
  AppOptions options = HeadlessApp::deterministic_options();
  RunningApp live(options);
  live.run(2500);
  live.model().record().write_history(file.path);
  REQUIRE(said(live.model(), Severity::note, "2500 ticks"));
  const ChannelStore& was = live.model().time().store();
  const auto opened = OpenedRecording::open(file.path, {});
  REQUIRE(opened);
  (*opened)->see_tick(0);
  for (int i = 0; i < 1000 && (*opened)->loading(); ++i) {
    (*opened)->update();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const ChannelStore& is = (*opened)->store();
  REQUIRE(is.first_tick() == was.first_tick());
  REQUIRE(is.end_tick() == was.end_tick());
  for (std::size_t channel = 0; channel < kChannelCount; ++channel) {
    CAPTURE(channel);
    std::size_t differ = 0;
    for (std::uint64_t tick = was.first_tick(); tick < was.end_tick(); ++tick) {
      const float a = was.value(channel, tick), b = is.value(channel, tick);
      differ += a == b || (std::isnan(a) && std::isnan(b)) ? 0 : 1;
    }
    CHECK(differ == 0);
  }
}

TEST_CASE("of a long recording a page is loaded, the rest is known by its minima and maxima, and stepping goes on") {
  const RecordedFile file;
  constexpr std::array kSome{Channel::force_x, Channel::force_computed, Channel::force_felt, Channel::cld_commanded,
                             Channel::iterations};
  std::vector<MinMax> were;
  const auto ranges = [&kSome](const ChannelStore& store) {
    std::vector<MinMax> found;
    for (const Channel of : kSome)
      for (std::uint64_t from = 0; from < 8192; from += 512)
        found.push_back(store.min_max(static_cast<std::size_t>(of), from, from + 512));
    return found;
  };
  {
    RunningApp live;
    live.run(9000);
    live.model().record().write_history(file.path);
    were = ranges(live.model().time().store());
  }
  OpenedApp ui(file.path, 2.0);  // pages of 2,000 ticks
  CHECK(ui.time().past().main().records.size() == 2000);
  CHECK(ui.time().store().end_tick() == 9000);
  const std::vector<MinMax> are = ranges(ui.time().store());
  REQUIRE(are.size() == were.size());
  for (std::size_t i = 0; i < are.size(); ++i) {
    CHECK(are[i].min == were[i].min);
    CHECK(are[i].max == were[i].max);
  }
  CHECK_FALSE(ui.time().store().min_max(static_cast<std::size_t>(Channel::force_z), 8990, 9000).empty());
  for (const std::uint64_t tick : {8999u, 0u, 4321u, 5320u, 5321u}) {
    ui.time().select_tick(tick);
    REQUIRE(ui.tick() == tick);
    CHECK_FALSE(ui.time().tick().iterations().empty());
  }
  // From the last tick of a page on to the next one.
  const std::uint64_t last = ui.time().past().main().records.newest().tick.tick;
  ui.time().select_tick(last);
  ui.time().step_tick(1);
  CHECK(ui.tick() == last + 1);
  ui.time().step_tick(-10);
  CHECK(ui.tick() == last - 9);
  ui.time().select_tick(8999);
  ui.time().step_tick(1);
  CHECK(ui.tick() == 8999);
  ui.time().select_tick(5);
  ui.time().step_tick(-10);
  CHECK(ui.tick() == 0);
}

TEST_CASE("what-if on a recording: another value gives a ghost, and the recorded ticks are the same bits") {
  const RecordedFile file;
  record_torus(file.path);
  OpenedApp ui(file.path);
  ui.time().select_tick(1000);
  REQUIRE(ui.time().time_machine().is_open());
  REQUIRE(ui.time().time_machine().verified() != nullptr);
  CHECK(ui.time().time_machine().verified()->numbers.different_ticks == 0);
  CHECK(ui.time().ghost() == nullptr);
  const PresetKey& tolerance = *find_preset_key("solver", "tolerance_m");
  ui.model().presets().set_value(tolerance, 2.0 * tolerance.get(ui.model().presets().current()));
  ui.frames(2);
  REQUIRE(ui.time().ghost() != nullptr);
  CHECK(ui.time().ghost()->channels->first_tick() == 200);
  CHECK(ui.time().ghost()->channels->end_tick() == 3000);
}

TEST_CASE("the servo and its history go on while a recording is looked at, and are there when it is closed") {
  const RecordedFile file;
  record_torus(file.path);
  RunningApp ui;
  ui.run(1500);
  Bookmarks& marks = ui.model().time().bookmarks();
  marks.set_note(marks.add(700, 0.7), "live");
  ui.model().open(file.path);
  ui.frames(2);
  REQUIRE(ui.model().time().recording() != nullptr);
  ui.app().advance(500);
  ui.frames(2);
  CHECK(ui.model().time().end_tick() == 3000);
  ui.key(HeadlessApp::kSpace);
  CHECK(ui.model().time().recording() != nullptr);
  CHECK(said(ui.model(), Severity::note, "End closes it"));
  ui.key(HeadlessApp::kEnd);
  ui.frame();
  CHECK(ui.model().time().recording() == nullptr);
  CHECK(ui.model().time().end_tick() == 2000);
  CHECK(ui.model().time().first_tick() == 0);
  const Bookmark* mark = ui.model().time().bookmarks().after(699);
  REQUIRE(mark != nullptr);
  CHECK(mark->note == "live");
}

TEST_CASE("a recording that was cut short opens up to its last whole batch, and says so") {
  const RecordedFile file;
  record_torus(file.path);
  change_file(file.path,
              "DELETE FROM meta WHERE key IN ('ended_utc', 'ticks'); DELETE FROM tick_rows WHERE tick >= 2700;"
              "DELETE FROM overview WHERE level > 0 OR first_tick > 2300");
  OpenedApp ui(file.path);
  REQUIRE(ui.time().recording() != nullptr);
  CHECK(said(ui.model(), Severity::warning, "cut short"));
  CHECK(ui.time().end_tick() == 2700);
  CHECK_FALSE(ui.time().store().min_max(static_cast<std::size_t>(Channel::iterations), 2690, 2700).empty());
  ui.time().select_tick(2699);
  CHECK_FALSE(ui.time().tick().iterations().empty());
}

TEST_CASE("kept states of another version: it opens for looking, and says why nothing is solved again") {
  const RecordedFile file;
  record_torus(file.path);
  change_file(file.path, "UPDATE meta SET value='999' WHERE key='state_layout'");
  OpenedApp ui(file.path);
  REQUIRE(ui.time().recording() != nullptr);
  CHECK(said(ui.model(), Severity::warning, "not solved again"));
  ui.time().select_tick(1234);
  CHECK(ui.tick() == 1234);
  CHECK(ui.time().tick().iterations().empty());
  CHECK(ui.time().tick().problem().find("kept states") != std::string::npos);
  CHECK_FALSE(ui.time().time_machine().is_open());
  CHECK_FALSE(ui.time().run_over({200, 2999}));
  ui.model().presets().set_value(*find_preset_key("solver", "tolerance_m"), 1e-5);
  ui.frames(2);
  CHECK(ui.time().ghost() == nullptr);
}

TEST_CASE("without its mesh a recording asks for it by name and hash, and takes no other") {
  const RecordedFile file;
  record_torus(file.path);
  change_file(file.path, "DELETE FROM scene_bytes; UPDATE scenes SET bytes_hash=NULL");
  OpenedApp ui(file.path);
  REQUIRE(ui.time().recording() != nullptr);
  CHECK(said(ui.model(), Severity::warning, "open torus (hash "));
  CHECK(ui.time().tick().iterations().empty());
  ui.model().open("cube");
  ui.frames(2);
  CHECK(ui.time().tick().iterations().empty());
  ui.model().open("torus");
  ui.frames(2);
  CHECK(said(ui.model(), Severity::note, "this is the mesh of run.sqlite"));
  CHECK_FALSE(ui.time().tick().iterations().empty());
}

TEST_CASE("what is no recording is an error that says so, and the window stays as it is") {
  const RecordedFile file;
  std::ofstream(file.path) << "not a database";
  RunningApp ui;
  ui.run(300);
  ui.model().open(file.path);
  ui.model().open(file.folder.file("none.sqlite"));
  ui.frames(2);
  CHECK(ui.model().time().recording() == nullptr);
  CHECK(said(ui.model(), Severity::error, "run.sqlite"));
  CHECK(said(ui.model(), Severity::error, "none.sqlite"));
  CHECK_FALSE(ui.model().time().paused());
}

TEST_CASE("a window that starts with a recording shows it, and one that can't be read gives the built-in scene") {
  const RecordedFile file;
  record_torus(file.path);
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = file.path;
  {
    RunningApp ui(options);
    REQUIRE(ui.model().time().recording() != nullptr);
    CHECK(ui.model().scene().current() != nullptr);
    CHECK(ui.model().devices().session() != nullptr);
  }
  options.mesh = file.folder.file("none.sqlite");
  RunningApp ui(options);
  CHECK(ui.model().time().recording() == nullptr);
  CHECK(ui.model().scene().current() != nullptr);
}

TEST_CASE("how long a recording takes to open, to draw and to jump in: of the file that TANGENT_LONG_RECORDING names") {
  const char* path = std::getenv("TANGENT_LONG_RECORDING");
  if (path == nullptr) {
    MESSAGE("skipped: TANGENT_LONG_RECORDING names no file");
    return;
  }
  const auto cpu_s = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  double began = cpu_s();
  const auto opened = OpenedRecording::open(path, {});
  REQUIRE_MESSAGE(opened, (opened ? "" : opened.error().message()));
  const RecordingInfo& info = (*opened)->info();
  MESSAGE("opened: " << info.ticks << " ticks in " << cpu_s() - began << " s of processor time");
  TimeAxis axis;
  axis.update(info.first_tick, info.last_tick + 1, static_cast<double>(info.last_tick + 1));
  axis.show_all();
  std::array<KeptBars, kChannelCount> bars;
  began = cpu_s();
  std::size_t columns = 0;
  for (std::size_t channel = 0; channel < kChannelCount; ++channel) {
    bars[channel].update((*opened)->store(), channel, axis, 1500.0f);
    columns += bars[channel].computed();
  }
  MESSAGE("first frame of all of it: " << columns << " columns in " << cpu_s() - began << " s");
  for (const std::uint64_t tick : {info.ticks / 2, info.ticks - 1, info.ticks / 7}) {
    began = cpu_s();
    CHECK((*opened)->see_tick(info.first_tick + tick));
    MESSAGE("jump to another hour: " << cpu_s() - began << " s");
  }
  began = cpu_s();
  while ((*opened)->loading())
    if ((*opened)->update())
      MESSAGE("loaded: " << (*opened)->page().records.size() << " ticks after " << cpu_s() - began << " s");
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK((*opened)->different() == 0);
}
