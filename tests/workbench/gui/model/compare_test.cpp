// Before and after: two presets over the same ticks, and tick by tick beside one another.
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/panels/iteration_columns.h"

#include <cmath>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

struct CompareApp : HeadlessApp {
  CompareApp() : HeadlessApp(options(), 1600.0f, 1600.0f) {}
  static AppOptions options() {
    AppOptions options = deterministic_options();
    options.mesh = "torus";
    return options;
  }
  void run(std::uint64_t ticks) {
    app().advance(ticks);
    frames(2);
  }
  void set(std::string_view key, double value) { model().presets().set_value(*find_preset_key("solver", key), value); }
  TimeModel& time() { return model().time(); }
  void select(std::uint64_t a, std::uint64_t b) {
    time().select_tick(a);
    frame();
    click("plots/cursor_a");
    time().select_tick(b);
    frame();
    click("plots/cursor_b");
  }
};

}  // namespace

TEST_CASE("before and after are one preset against one over one range, though the recording spans three") {
  CompareApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.001);
  ui.run(2000);
  ui.set("method", static_cast<double>(Method::robust));
  ui.run(2000);
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.010);
  ui.run(2000);
  ui.select(2500, 3499);
  ui.set("gain_curvature_m", 0.020);
  ui.frame();
  const auto both = ui.time().time_machine().compared();
  REQUIRE(both != nullptr);
  CHECK(both->before.solver.gain_curvature_m == 0.010);
  CHECK(both->after.solver.gain_curvature_m == 0.020);
  CHECK(both->before_numbers.ticks == 1000);
  CHECK(both->from_tick == 2500);
  CHECK(both->end_tick == 3500);
  CHECK(both->before_ns == 0.0);
  // The recorded ticks there ran under robust, which is in neither column.
  CHECK(both->before_numbers.mean_iterations != ui.time().ghost()->numbers.recorded.mean_iterations);
  ui.click("plots/cursor_a");  // no range any more: all ticks
  ui.frame();
  REQUIRE(ui.time().time_machine().compared() != nullptr);
  CHECK(ui.time().time_machine().compared()->before_numbers.ticks == 6000);
}

TEST_CASE("any preset is solved against any other from A to B, by a button") {
  CompareApp ui;
  ui.run(3000);
  ui.select(1000, 1999);
  ui.time().go_live();
  ui.model().presets().copy_ab();
  ui.model().presets().toggle_ab();
  ui.set("method", static_cast<double>(Method::newton));
  ui.model().presets().toggle_ab();
  ui.run(100);
  ui.click("compare/solve");
  REQUIRE(ui.time().paused());
  const auto both = ui.time().time_machine().compared();
  REQUIRE(both != nullptr);
  CHECK(both->before.solver.method == Method::robust);
  CHECK(both->after.solver.method == Method::newton);
  CHECK(both->before_numbers.ticks == 1000);
  CHECK(ui.time().name_before() == "A");
  CHECK(ui.time().name_after() == "B");
  REQUIRE(ui.time().ghost() != nullptr);
  CHECK(ui.time().ghost()->preset.solver.method == Method::newton);
}

TEST_CASE("the ghost's planes stand beside those of the tick in view, and are those of its curve") {
  CompareApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.run(4000);
  ui.time().select_tick(3000);
  ui.frame();
  CHECK_FALSE(ui.time().beside().shown());
  ui.set("gain_curvature_m", 0.002);
  for (const std::uint64_t tick : {3000u, 3001u, 2048u, 700u}) {
    ui.time().select_tick(tick);
    ui.frame();
    REQUIRE(ui.time().beside().shown());
    CHECK(ui.time().beside().carried());
    const Ghost& ghost = *ui.time().ghost();
    const auto channel = [&](GhostChannel c) { return ghost.channels->value(static_cast<std::size_t>(c), tick); };
    CHECK(static_cast<float>(ui.time().beside().output().iterations) == channel(GhostChannel::iterations));
    CHECK(static_cast<float>(ui.time().beside().output().error_m) == channel(GhostChannel::error));
    CHECK(ui.app().items().find("iterations/beside") != nullptr);
    CHECK(ui.time().tick().record()->tick.tick == tick);
  }
  ui.time().go_live();
  ui.frame();
  CHECK_FALSE(ui.time().beside().shown());
}

TEST_CASE("two solvers side by side while live: the other slot solves the tick in view too") {
  CompareApp ui;
  ui.model().presets().copy_ab();
  ui.model().presets().toggle_ab();
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.0);
  ui.model().presets().toggle_ab();
  ui.run(500);
  CHECK_FALSE(ui.time().beside().shown());
  ui.click("compare/beside");
  for (int i = 0; i < 5; ++i) {
    ui.run(150);
    REQUIRE(ui.time().beside().shown());
    CHECK_FALSE(ui.time().paused());
    CHECK(ui.time().beside().preset().solver.method == Method::paper);
    CHECK(ui.time().beside().carried());
    REQUIRE(ui.time().ghost_channels() != nullptr);
    const std::uint64_t tick = ui.time().tick().record()->tick.tick;
    CHECK(static_cast<float>(ui.time().beside().output().iterations) ==
          ui.time().ghost_channels()->value(static_cast<std::size_t>(GhostChannel::iterations), tick));
    CHECK(static_cast<int>(ui.time().beside().iterations().size()) > ui.time().beside().output().iterations);
  }
  // Every tick is solved, by a solver that carries its own contact from the first one on.
  const RecordedRun run = ui.model().devices().session()->recorded_run();
  const auto kept = ui.time().ghost_channels();
  const ChannelStore& live = *kept;
  CHECK(live.first_tick() == 0);
  CHECK(live.end_tick() == run.records.newest().tick.tick + 1);
  Stepper stepper(run.scenes.begin()->second);
  TickState state = run.records[0].tick.kept;
  const Preset& other = ui.time().beside().preset();
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const TickOutput out = stepper.step(other, run.records[i].tick.input, state);
    CHECK(static_cast<float>(out.iterations) == live.value(static_cast<std::size_t>(GhostChannel::iterations), i));
  }
  ui.time().set_paused(true);
  ui.frame();
  CHECK(ui.time().ghost_channels() == nullptr);
  CHECK(ui.time().beside().shown());
}

TEST_CASE("the table's columns are chosen, its height is dragged, and its ratio is of measured errors") {
  CompareApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.002);
  ui.run(3000);
  ui.click("transport/pause");
  const auto height = [&] {
    const ItemRect* table = ui.app().items().find("iterations/table");
    return table->max.y - table->min.y;
  };
  const float before = height();
  ui.drag("iterations/height", {0.0f, 150.0f});
  CHECK(height() > before + 100.0f);
  ui.click("iterations/columns");
  ui.frame();
  ui.click("iterations/column/ratio");
  ui.click("iterations/column/curvature");
  const auto planes = ui.time().tick().iterations();
  REQUIRE(planes.size() >= 2);
  CHECK(std::isnan(error_ratio(planes, 0)));
  CHECK(error_ratio(planes, 1) == planes[1].error_m / planes[0].error_m);
  CHECK(iteration_cell(planes, 0, IterationColumn::ratio).empty());
  CHECK(last_stop(planes) == std::string(to_string(planes.back().stop)));
  CHECK(ui.app().items().find("iterations/summary") != nullptr);
}
