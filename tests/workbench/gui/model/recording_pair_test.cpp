// Two recordings compared in the window: the outcome, curves, the way to the largest difference.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/recording/session_recorder.h"

#include "core/lab/objects/generate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

using namespace tangent;
using tangent::test::RunningApp;
using tangent::test::said;

namespace {

/// 2 s on a ball. `marked`: a tick that is bookmarked; 0: none.
void record_ball(const std::filesystem::path& path, double stiffness_n_per_m, std::uint64_t marked = 0) {
  const SceneSource source{std::make_shared<const PolygonMesh>(make_icosphere(0.040, 3)), {}, nullptr};
  auto scene = build_scene(source);
  REQUIRE(scene);
  SessionOptions options;
  options.threaded = false;
  options.history_s = 1.0;
  Preset preset;
  preset.force.stiffness_n_per_m = stiffness_n_per_m;
  auto session = Session::create(*scene, preset, options);
  REQUIRE(session);
  auto recorder = SessionRecorder::start(**session, path, {source, "ball", false});
  REQUIRE(recorder);
  REQUIRE((*session)->start());
  if (marked > 0) (*recorder)->add_event({marked, 1e-3 * static_cast<double>(marked), "bookmark", "here"});
  for (int i = 0; i < 2; ++i) {
    (*session)->advance(1000);
    (*recorder)->poll();
  }
  REQUIRE((*session)->shut_down());
  REQUIRE((*recorder)->finish());
}

struct RecordingsApp : RunningApp {
  explicit RecordingsApp(bool deterministic = true) : RunningApp(options(deterministic), 1600.0f, 4200.0f) {
    model().window().open_sections()["Compare recordings"] = true;
  }
  static AppOptions options(bool deterministic) {
    AppOptions options = deterministic_options();
    options.deterministic = deterministic;
    return options;
  }
  RecordingPairModel& recordings() { return model().recording_pair(); }
  /// What is in view: the recording's file, and the tick.
  bool shows(const std::filesystem::path& file, std::uint64_t tick) {
    const OpenedRecording* open = model().time().recording();
    return open != nullptr && open->path() == file && model().time().tick().record()->tick.tick == tick;
  }
  void compare(const std::string& a, const std::string& b, AlignBy by = AlignBy::time) {
    recordings().first = a;
    recordings().second = b;
    recordings().by = by;
    recordings().compare();
    frames(2);
    REQUIRE(recordings().result() != nullptr);
  }
};

}  // namespace

TEST_CASE("two recordings are compared in the window, and the largest difference is one click away") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_ball(a, 400.0);
  record_ball(b, 420.0);
  RecordingsApp ui;
  ui.recordings().compare();
  CHECK(said(ui.model(), Severity::note, "name the first recording"));
  ui.recordings().first = a;
  ui.recordings().second = b;
  ui.frame();
  ui.click("recordings/compare");
  REQUIRE(ui.recordings().result() != nullptr);
  const RecordingsCompared whole = *ui.recordings().result();
  CHECK(whole.full);
  CHECK(whole.compared == 2000);
  CHECK(whole.outcome == CompareOutcome::different);
  CHECK(ui.app().items().find("recordings/plot") != nullptr);
  double largest = 0.0;
  for (const ComparedBin& bin : whole.bins) largest = std::max(largest, bin.at_most[0]);
  ui.click("recordings/largest");
  const RecordingsCompared near = *ui.recordings().result();
  CHECK(near.compared < 600);
  double there = 0.0;
  for (const ComparedBin& bin : near.bins) there = std::max(there, bin.at_most[0]);
  CHECK(there == largest);
  ui.click("recordings/whole");
  CHECK(ui.recordings().result()->compared == 2000);
  const auto spectrum = [&](std::string_view channel) {
    const auto at = std::find(kComparedChannels.begin(), kComparedChannels.end(), channel);
    ui.recordings().channel = static_cast<std::size_t>(at - kComparedChannels.begin());
    ui.frame();
    ui.frame();
    return ui.app().items().find("recordings/spectrum");
  };
  CHECK(spectrum("force_z_n") != nullptr);
  CHECK(spectrum("penetration_m") == nullptr);
  ui.recordings().channel = 0;
  ui.click("recordings/largest");  // half a second: less than a window
  CHECK(spectrum("force_z_n") == nullptr);
}

TEST_CASE("without a second recording the first is compared with its motion under the present values") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite");
  record_ball(a, Preset{}.force.stiffness_n_per_m);
  RecordingsApp ui;
  ui.recordings().first = a;
  ui.recordings().compare();
  CHECK(ui.recordings().result()->outcome == CompareOutcome::same);
  ui.model().presets().set_value(*find_preset_key("force.stiffness_n_per_m"), 900.0);
  ui.recordings().compare();
  CHECK(ui.recordings().result()->outcome == CompareOutcome::different);
}

TEST_CASE("recordings are compared in the background, and what can't be is a message") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite");
  record_ball(a, 400.0);
  RecordingsApp ui(false);
  ui.recordings().first = a;
  ui.recordings().second = folder.file("none.sqlite");
  ui.recordings().compare();
  const auto wait = [&] {
    for (int i = 0; i < 2000 && ui.recordings().running(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ui.frame();
  };
  wait();
  CHECK(said(ui.model(), Severity::error, "none.sqlite"));
  CHECK(ui.recordings().result() == nullptr);
  ui.recordings().second = a;
  ui.recordings().by = AlignBy::bookmark;
  ui.recordings().compare();
  wait();
  REQUIRE(ui.recordings().result() != nullptr);
  CHECK(ui.recordings().result()->outcome == CompareOutcome::not_aligned);
  ui.frame();
  CHECK(ui.app().items().find("recordings/outcome") != nullptr);
}

TEST_CASE("a click on the curves or on a difference opens its tick in the first, and what goes with it in the second") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_ball(a, 400.0, 500);
  record_ball(b, 420.0, 700);
  RecordingsApp ui;
  ui.compare(a, b, AlignBy::bookmark);
  const RecordingsCompared found = *ui.recordings().result();
  REQUIRE(found.alignment.shift == 200);
  CHECK(ui.model().time().recording() == nullptr);
  // Without a place that was chosen: the largest difference of what is drawn.
  ui.click("recordings/in_second");
  REQUIRE(ui.model().time().recording() != nullptr);
  CHECK(ui.model().time().recording()->path() == b);
  CHECK_FALSE(ui.recordings().chosen());
  for (const float across : {0.1f, 0.5f, 0.93f}) {
    const ItemRect plot = *ui.app().items().find("recordings/plot");  // what is above it may have grown
    const float width = plot.max.x - plot.min.x, x = std::floor(plot.min.x + across * width);
    ui.move({x, plot.centre().y});
    ui.press();
    ui.release();
    ui.frame();
    const auto bin = static_cast<std::size_t>((x - plot.min.x) / width * static_cast<float>(found.bins.size()));
    REQUIRE(ui.recordings().chosen());
    CHECK(*ui.recordings().chosen() >= found.bins[bin].first);
    CHECK(*ui.recordings().chosen() < found.bins[bin].first + found.bins[bin].ticks);
    CHECK(ui.shows(a, *ui.recordings().chosen()));
    ui.click("recordings/in_second");
    CHECK(ui.shows(b, *ui.recordings().chosen() + 200));
    ui.click("recordings/in_first");
    CHECK(ui.shows(a, *ui.recordings().chosen()));
  }
  ui.click("recordings/difference/" + std::string(found.quantities[0].name));
  CHECK(*ui.recordings().chosen() == found.quantities[0].worst_tick);
  CHECK(ui.shows(a, found.quantities[0].worst_tick));
}

TEST_CASE("commands show a tick of two recordings, within what they have in common, or say why not") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_ball(a, 400.0, 500);
  record_ball(b, 420.0, 700);
  RecordingsApp ui;
  MenuBar menu;
  const auto run = [&](const char* line) {
    REQUIRE(run_line(window_commands(ui.model(), menu), line));
    ui.frames(2);
  };
  run("compared in first");
  CHECK(said(ui.model(), Severity::note, "no recordings are compared yet"));
  ui.compare(a, b, AlignBy::bookmark);
  run("compared tick 800");
  CHECK(ui.shows(a, 800));
  run("compared in second");
  CHECK(ui.shows(b, 1000));
  run("compared tick 99999");
  CHECK(ui.shows(a, 1799));
  ui.compare(a, {});
  run("compared in second");
  CHECK(said(ui.model(), Severity::note, "under the present values"));
  CHECK(ui.shows(a, 1799));
}

TEST_CASE("with threads the tick of a comparison is in view when its recording was read, unless another was opened") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_ball(a, 400.0);
  record_ball(b, 420.0);
  RecordingsApp ui(false);
  const auto wait = [&ui] {
    for (int i = 0; i < 2000 && ui.model().recordings().opening(); ++i, ui.frame())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  ui.model().open_at({b, 1234});
  wait();
  CHECK(ui.shows(b, 1234));
  ui.model().open_at({a, 77});
  ui.model().open(b);
  wait();
  CHECK(ui.shows(b, 0));
}
