// Tuning in the window, driven as a person does: start, watch the front grow, brush, try, keep, save, cancel, quit.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/evidence/check_preset.h"
#include "workbench/gui/panels/commands.h"

#include <algorithm>
#include <chrono>
#include <thread>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::said;

namespace {

struct TuneApp : HeadlessApp {
  explicit TuneApp(AppOptions options = on_torus()) : HeadlessApp(std::move(options), 1600.0f, 3000.0f) {
    model().window().open_sections()["Tune"] = true;
    model().presets().set_value(*find_preset_key("solver.method"), static_cast<double>(Method::paper));
    frame();
  }
  static AppOptions on_torus() {
    AppOptions options = deterministic_options();
    options.mesh = "torus";
    return options;
  }
  void run(std::uint64_t ticks) {
    app().advance(ticks);
    frames(2);
  }
  /// Until the search has ended.
  void finish() {
    for (int i = 0; i < 1000 && tune().running(); ++i) frame();
    REQUIRE_FALSE(tune().running());
    frames(2);
  }
  TuneModel& tune() { return model().tune(); }
  Status command(const std::string& line) {
    MenuBar menu;
    return run_line(window_commands(model(), menu), line);
  }
  const Preset& now() { return model().presets().current(); }
  std::size_t slot() { return model().presets().slots().active_slot(); }
};

double gain_in_use(const Preset& preset) { return preset.solver.gain_curvature_m; }

/// Its gain, where it is not the one in use.
std::size_t another_trial(TuneApp& ui) {
  for (const std::size_t i : ui.tune().listed())
    if (ui.tune().trials()[i].values[0] != gain_in_use(ui.now())) return i;
  FAIL("all trials are alike");
  return 0;
}

}  // namespace

TEST_CASE("a tuner starts a search, sees the front grow, and it never gets worse") {
  TuneApp ui;
  ui.run(800);
  REQUIRE(ui.command("tune trials 60"));
  ui.click("tune/start");
  REQUIRE(ui.tune().running());
  std::size_t before = 0, grew = 0;
  while (ui.tune().running()) {
    ui.frame();
    const auto& trials = ui.tune().trials();
    grew += trials.size() > before ? 1 : 0;
    before = trials.size();
    CHECK(ui.tune().front() == sweep::front_of(trials));
  }
  CHECK(grew >= 3);
  CHECK(before == 60);
  ui.frames(2);
  CHECK(ui.app().items().find("tune/front") != nullptr);
  CHECK(ui.app().items().find("tune/values") != nullptr);
  REQUIRE(ui.tune().verdict());
  REQUIRE(ui.tune().balanced());
  CHECK(ui.tune().trials()[*ui.tune().balanced()].missed == 0.0);
  CHECK(ui.tune().theory(0) == ui.now().finger.reach_m());
  CHECK(ui.tune().motion_text() == "800 ticks in view");
}

TEST_CASE("a rectangle drawn in either plot brushes trials, the table follows, a click beside them lets go") {
  TuneApp ui;
  ui.run(600);
  REQUIRE(ui.command("tune trials 40"));
  ui.click("tune/start");
  ui.finish();
  for (const char* plot : {"tune/front", "tune/values"}) {
    CAPTURE(plot);
    const ItemRect item = *ui.app().items().find(plot);
    const float w = item.max.x - item.min.x, h = item.max.y - item.min.y;
    const ImVec2 from{item.min.x + 0.3f * w, item.min.y + 0.2f * h}, to{item.max.x - 3.0f, item.max.y - 0.3f * h};
    ui.move(from);
    ui.press();
    ui.move({0.5f * (from.x + to.x), 0.5f * (from.y + to.y)});
    ui.move(to);
    ui.release();
    ui.frame();
    REQUIRE(ui.tune().brush());
    CHECK_FALSE(ui.tune().in_use());
    std::vector<std::size_t> listed = ui.tune().listed();
    std::sort(listed.begin(), listed.end());
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < ui.tune().trials().size(); ++i)
      if (ui.tune().brushed(i)) inside.push_back(i);
    CHECK(listed == inside);
    CHECK(inside.size() < 40);
    CHECK(ui.tune().brush()->axes[0].key == (std::string(plot) == "tune/values"));
    ui.click("tune/no_brush");
    CHECK_FALSE(ui.tune().brush());
    CHECK(ui.tune().listed() == ui.tune().front());
  }
  REQUIRE(ui.command("tune brush mean_iterations 0 1000 gain_curvature_m 0 20"));
  for (const std::size_t i : ui.tune().listed()) CHECK(ui.tune().trials()[i].values[0] <= 0.02);
  CHECK_FALSE(ui.command("tune brush mean_iterations 3 1 gain_curvature_m 0 20"));
  CHECK_FALSE(ui.command("tune brush speed 1 3 gain_curvature_m 0 20"));
  CHECK_FALSE(ui.command("tune brush mean_iterations 1 3"));
}

TEST_CASE("a trial that is clicked runs on the servo beside what there was, is a ghost on the past, kept or put back") {
  TuneApp ui;
  ui.run(600);
  const Preset before = ui.now();
  REQUIRE(ui.command("tune trials 40"));
  ui.click("tune/start");
  ui.finish();
  ui.model().time().set_paused(true);
  ui.frames(5);
  const std::size_t trial = another_trial(ui);
  ui.click("tune/trial/" + std::to_string(trial));
  CHECK(ui.tune().tried() == trial);
  CHECK(ui.slot() == 1);
  CHECK(gain_in_use(ui.now()) == ui.tune().trials()[trial].values[0]);
  CHECK(ui.model().devices().session()->preset() == ui.now());
  CHECK(ui.model().presets().slots().slot(0).current() == before);
  for (int i = 0; i < 200 && ui.model().time().ghost() == nullptr; ++i) ui.frame();
  CHECK(ui.model().time().ghost() != nullptr);
  ui.key('B');
  CHECK(ui.now() == before);
  CHECK_FALSE(ui.tune().tried());
  ui.key('B');
  CHECK(ui.tune().tried() == trial);
  ui.frame();
  ui.click("tune/put_back");
  CHECK(ui.now() == before);
  CHECK(ui.slot() == 0);
  // On the front's plot this time; undone in one step.
  const std::string point = "tune/front/" + std::to_string(trial);
  REQUIRE(ui.app().items().find(point) != nullptr);
  ui.move(ui.app().items().find(point)->centre());
  ui.press();
  ui.release();
  ui.frame();
  REQUIRE(ui.tune().tried());
  ui.model().presets().undo();
  CHECK(ui.now() == before);
  ui.frame();
  REQUIRE(ui.command("tune try " + std::to_string(trial + 1)));
  ui.frames(2);
  ui.click("tune/keep");
  CHECK(ui.slot() == 0);
  CHECK(gain_in_use(ui.now()) == ui.tune().trials()[trial].values[0]);
  CHECK(ui.model().presets().slots().slot(1).current() == ui.now());
  CHECK(ui.tune().in_use() == trial);
  CHECK_FALSE(ui.tune().tried());
}

TEST_CASE("a trial is saved with the motion it was tuned on as evidence, which holds when it is checked") {
  for (const char* motion : {"ticks", "exploration"}) {
    CAPTURE(motion);
    const testing::TempFolder folder;
    AppOptions options = TuneApp::on_torus();
    options.preset_folder = folder.path();
    TuneApp ui(options);
    ui.run(600);
    REQUIRE(ui.command(std::string("tune motion ") + motion));
    REQUIRE(ui.command("tune trials 12"));
    REQUIRE(ui.command("tune start"));
    ui.finish();
    CHECK_FALSE(ui.command("tune save early"));
    REQUIRE(ui.command("tune try middle"));
    REQUIRE(ui.command("tune save mine"));
    ui.frames(3);
    const auto saved = read_preset(folder.path() / "mine.toml");
    REQUIRE(saved);
    CHECK(saved->preset == ui.now());
    CHECK(saved->about.note.find("mean_iterations error_p99_m, unconverged = 0, on ") != std::string::npos);
    REQUIRE(saved->about.measured);
    CHECK((saved->about.measured->motion.kind == MotionKind::around) == (std::string(motion) == "exploration"));
    CHECK_FALSE(ui.command("tune save mine"));
    ui.model().evidence().check();
    ui.frame();
    REQUIRE(ui.model().evidence().result() != nullptr);
    CHECK(ui.model().evidence().result()->outcome == CheckOutcome::holds);
  }
}

TEST_CASE("the map of the mesh shows where the listed trials fail, and follows the brush") {
  TuneApp ui;
  ui.run(1500);
  REQUIRE(ui.command("tune no constraints"));
  REQUIRE(ui.command("tune range solver.gain_curvature_m 0 0.08"));  // m, as in presets
  CHECK(ui.tune().question().ranges[0].to == 0.08);
  CHECK_FALSE(ui.command("tune range solver.gain_curvature_m 0 80"));
  REQUIRE(ui.command("tune range gain_curvature_m 0 3"));  // mm, as in its field
  REQUIRE(ui.command("tune trials 30"));
  REQUIRE(ui.command("tune start"));
  ui.finish();
  CHECK_FALSE(ui.tune().paint(ColourMap::tide));
  REQUIRE(ui.command("tune brush gain_curvature_m 0 3 mean_iterations 0 1000"));
  REQUIRE(ui.command("tune failures on"));
  const auto paint = ui.tune().paint(ColourMap::dusk);
  REQUIRE(paint);
  CHECK(paint->values.size() == ui.model().mesh()->usable_triangle_count());
  CHECK(ui.tune().most_failures() > 0.0);
  CHECK(std::any_of(paint->values.begin(), paint->values.end(), [](float v) { return is_map_value(v) && v > 0.0f; }));
  const std::uint64_t version = paint->version;
  REQUIRE(ui.command("tune let go"));
  REQUIRE(ui.tune().paint(ColourMap::dusk));
  CHECK(ui.tune().paint(ColourMap::dusk)->version != version);
  ui.model().scene().open("icosphere");
  ui.frames(3);
  CHECK_FALSE(ui.tune().paint(ColourMap::dusk));
  CHECK(ui.tune().outdated());
}

TEST_CASE("a search that is cancelled keeps what it has, and what was asked stays with it") {
  TuneApp ui;
  ui.run(800);
  REQUIRE(ui.command("tune trials 400"));
  ui.click("tune/start");
  ui.frames(3);
  ui.click("tune/cancel");
  CHECK_FALSE(ui.tune().running());
  const std::size_t kept = ui.tune().trials().size();
  CHECK(kept > 0);
  CHECK(kept < 400);
  ui.frames(3);
  CHECK(ui.tune().trials().size() == kept);
  REQUIRE(ui.command("tune second none"));
  CHECK(ui.tune().asked().objectives.size() == 2);
  CHECK(ui.tune().question().objectives.size() == 1);
  ui.click("tune/clear");
  CHECK(ui.tune().trials().empty());
}

TEST_CASE("the question: objectives, constraints and ranges by command, and what is wrong with them is said") {
  TuneApp ui;
  CHECK(ui.tune().question().ranges.size() == 4);
  REQUIRE(ui.command("tune first closed_work_share"));
  REQUIRE(ui.command("tune third p99_iterations"));
  CHECK(ui.tune().question().objectives[0].name() == "closed_work_share");
  CHECK(ui.tune().question().objectives[2].name() == "p99_iterations");
  REQUIRE(ui.command("tune first p99_iterations"));  // changes places
  CHECK(ui.tune().question().objectives[2].name() == "closed_work_share");
  CHECK_FALSE(ui.command("tune first speed"));
  REQUIRE(ui.command("tune keep to p99_iterations <= 6"));
  CHECK(ui.command("tune keep to p99_iterations <= 6"));  // it is kept to already
  CHECK_FALSE(ui.command("tune keep to p99_iterations <= 7"));
  CHECK_FALSE(ui.command("tune keep to speed = 0"));
  CHECK(ui.tune().question().constraints.size() == 2);
  REQUIRE(ui.command("tune without gain_overall"));
  CHECK_FALSE(ui.command("tune without gain_overall"));
  CHECK_FALSE(ui.command("tune range gain_curvature_m 20 20"));
  CHECK_FALSE(ui.command("tune range speed 1 2"));
  REQUIRE(ui.command("tune range solver.max_iterations 2 20"));
  CHECK(ui.tune().question().ranges.back().to == 20.0);
  // They are a person's now, and no longer the method's.
  ui.model().presets().set_value(*find_preset_key("solver.method"), static_cast<double>(Method::robust));
  ui.frame();
  CHECK(ui.tune().question().ranges.size() == 4);
  for (const char* key :
       {"solver.gain_curvature_m", "solver.gain_distance_per_m", "solver.tolerance_m", "solver.max_iterations"})
    REQUIRE(ui.command(std::string("tune without ") + key));
  REQUIRE(ui.command("tune start"));
  CHECK_FALSE(ui.tune().running());
  CHECK(said(ui.model(), Severity::note, "choose a value to tune first"));
  REQUIRE(ui.command("tune motion recording"));
  REQUIRE(ui.command("tune range tolerance_m 0.01 1"));
  REQUIRE(ui.command("tune start"));
  CHECK(said(ui.model(), Severity::note, "no recording is open"));
}

TEST_CASE("built without pagmo the panel says so, and even draws, the heat map and sweeps still work") {
  TuneApp ui;
  ui.run(400);
  ui.tune().leave_out_search(true);
  REQUIRE(ui.command("tune trials 20"));
  ui.click("tune/start");
  ui.finish();
  CHECK(ui.tune().trials().size() == 20);
  ui.click("tune/clear");
  ui.tune().leave_out_search(false);
  REQUIRE(ui.command("tune search even"));
  ui.click("tune/start");
  ui.finish();
  CHECK(ui.tune().trials().size() == 20);
}

TEST_CASE("a window is closed while it tunes and sweeps in the background, and nothing is left behind") {
  AppOptions options;
  options.mesh = "torus";
  HeadlessApp ui(options);
  TuneModel& tune = ui.model().tune();
  tune.set_trials(TuneQuestion::kMostTrials);
  tune.set_motion(TuneMotion::exploration);
  for (int i = 0; i < 3000 && ui.model().mesh() == nullptr; ++i) ui.frame();
  tune.start();
  REQUIRE(tune.running());
  for (int i = 0; i < 3000 && tune.trials().size() < 3; ++i) {
    ui.frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(tune.trials().size() >= 3);
  CHECK(tune.running());
  ui.model().tuning().start_sweep();
}
