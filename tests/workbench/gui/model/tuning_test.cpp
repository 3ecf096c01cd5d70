// Tuning on recorded ticks: sweeps and advice on gains.
#include "tests/support/approx.h"
#include "tests/workbench/gui/headless_app.h"

#include <algorithm>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;

namespace {

struct TuningApp : HeadlessApp {
  explicit TuningApp(const char* mesh = "torus") : HeadlessApp(options(mesh), 1600.0f, 2600.0f) {
    model().window().open_sections()["Sweep"] = true;
    set("method", static_cast<double>(Method::paper));
  }
  static AppOptions options(const char* mesh) {
    AppOptions options = deterministic_options();
    options.mesh = mesh;
    return options;
  }
  void run(std::uint64_t ticks) {
    app().advance(ticks);
    frames(2);
  }
  void set(std::string_view key, double value) { model().presets().set_value(*find_preset_key("solver", key), value); }
  void select(std::uint64_t a, std::uint64_t b) {
    model().time().select_tick(a);
    frame();
    click("plots/cursor_a");
    model().time().select_tick(b);
    frame();
    click("plots/cursor_b");
  }
  const SolverSettings& solver() { return model().presets().current().solver; }
};

}  // namespace

TEST_CASE("a sweep over A to B leaves points, a click tries one, and values tried by hand join them") {
  TuningApp ui;
  ui.run(2500);
  ui.select(1000, 1499);
  ui.model().tuning().set_range(0, 0.0, 0.024);
  ui.model().tuning().set_count(0, 5);
  ui.click("sweep/start");
  REQUIRE(ui.model().tuning().points().size() == 5);
  CHECK(ui.model().tuning().points_range() == TickRange{1000, 1499});
  for (const auto& p : ui.model().tuning().points()) CHECK(p.numbers.ticks == 500);
  CHECK(ui.model().tuning().points()[0].numbers.mean_iterations >
        ui.model().tuning().points()[4].numbers.mean_iterations);
  ui.frame();
  ui.click("sweep/point/2");
  CHECK(ui.solver().gain_curvature_m == 0.012);
  CHECK(ui.model().tuning().points().size() == 5);
  ui.set("gain_curvature_m", 0.0155);
  ui.frame();
  REQUIRE(ui.model().tuning().points().size() == 6);
  CHECK(ui.model().tuning().points()[3].by_hand);
  CHECK(ui.model().tuning().points()[3].values[0] == 0.0155);
  CHECK_FALSE(ui.model().tuning().outdated());
  ui.set("gain_overall", 0.9);
  ui.frame();
  CHECK(ui.model().tuning().points().size() == 6);
  CHECK(ui.model().tuning().outdated());
  ui.click("sweep/clear");
  CHECK(ui.model().tuning().points().empty());
}

TEST_CASE("two keys make a field, and trying a cell is one step of undo") {
  TuningApp ui;
  ui.run(800);
  ui.model().tuning().set_key(1, find_preset_key("solver", "gain_overall"));
  ui.model().tuning().set_range(1, 0.8, 1.2);
  ui.model().tuning().set_count(0, 3);
  ui.model().tuning().set_count(1, 3);
  ui.click("sweep/start");
  REQUIRE(ui.model().tuning().points().size() == 9);
  const SolverSettings before = ui.solver();
  ui.frame();
  ui.click("sweep/point/1");
  CHECK(ui.solver().gain_overall == ui.model().tuning().points()[1].values[1]);
  CHECK(ui.solver().gain_curvature_m == ui.model().tuning().points()[1].values[0]);
  ui.model().presets().undo();
  CHECK(ui.solver() == before);
}

TEST_CASE("the heat map is G_k by G_d where no second key is chosen, the cells of a sweep, and a click tries one") {
  TuningApp ui;
  ui.run(300);
  ui.click("sweep/heat_map");
  TuningModel& tuning = ui.model().tuning();
  CHECK(tuning.axes()[0].key == find_preset_key("solver.gain_curvature_m"));
  CHECK(tuning.axes()[1].key == find_preset_key("solver.gain_distance_per_m"));
  REQUIRE(tuning.points().size() == 17 * 17);
  CHECK(tuning.theory(0) == ui.model().presets().current().finger.reach_m());
  CHECK(tuning.theory(1) == 0.0);
  std::uint64_t failed = 0;
  for (const auto& point : tuning.points()) failed += TuningModel::failures(point);
  CHECK(failed > 0);
  for (const auto shows : {TuningModel::Shows::p99, TuningModel::Shows::failures, TuningModel::Shows::mean}) {
    tuning.shows = shows;
    ui.frames(2);
  }
  ui.click("sweep/point/40");
  CHECK(ui.solver().gain_curvature_m == tuning.points()[40].values[0]);
  CHECK(ui.solver().gain_distance_per_m == tuning.points()[40].values[1]);
  ui.set("method", static_cast<double>(Method::robust));
  tuning.set_key(1, nullptr);
  tuning.start_heat_map();
  CHECK_FALSE(tuning.sweep().running());
  CHECK(tuning.points().empty());
}

TEST_CASE("gains are advised only where they leave less by the number shown - taken, they are not advised again") {
  TuningApp ui;
  ui.run(3000);
  int advised = 0, silent = 0;
  for (std::uint64_t tick = 200; tick < 3000; tick += 100) {
    ui.model().time().select_tick(tick);
    ui.set("gain_overall", 1.0);
    ui.set("gain_curvature_m", tick % 200 == 0 ? 0.006 : 0.020);
    ui.set("gain_distance_per_m", 0.0);
    ui.frame();
    const auto advice = ui.model().tuning().advice_here();
    const bool offered = ui.app().items().find("solver/advice/set") != nullptr;
    CHECK(offered == (advice && advice->better()));
    if (!offered) {
      ++silent;
      continue;
    }
    ++advised;
    CHECK(std::round(100.0 * advice->left_advised) < std::round(100.0 * advice->left_now));
    ui.click("solver/advice/set");
    CHECK(gains_of(ui.solver()) == advice->advised);
    ui.frame();
    const auto after = ui.model().tuning().advice_here();
    REQUIRE(after);
    CHECK(after->left_now == approx(advice->left_advised));
    CHECK_FALSE(after->better());
    CHECK(ui.app().items().find("solver/advice/set") == nullptr);
  }
  CHECK(advised + silent == 28);
  CHECK(advised > 0);
}

TEST_CASE("gains searched over A to B beat the present ones by their score, or nothing is advised") {
  TuningApp ui("cube");
  ui.run(2000);
  ui.select(1500, 1699);
  ui.click("solver/advice/search");
  const auto found = ui.model().tuning().found();
  REQUIRE(found != nullptr);
  CHECK(found->first_tick == 1500);
  CHECK(found->last_tick == 1699);
  ui.frame();
  const bool offered = ui.app().items().find("solver/advice_range/set") != nullptr;
  CHECK(offered == shows_better(found->now, found->best.score));
  if (offered) ui.click("solver/advice_range/set");
  ui.frame();
  CHECK(ui.app().items().find("solver/advice_range/set") == nullptr);
  ui.set("tolerance_m", 1e-5);  // another question
  CHECK(ui.model().tuning().found() == nullptr);
}
