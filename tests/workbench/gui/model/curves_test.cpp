// Speed against error in the window: measured on the chosen ticks, drawn, and its points opened.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/drawn_text.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/bench/speed_curves.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/curves_plot.h"

#include <algorithm>
#include <cmath>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

namespace {

AppOptions curves_options(bool deterministic = true) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "torus";
  options.deterministic = deterministic;
  return options;
}

struct CurvesApp : RunningApp {
  explicit CurvesApp(AppOptions options = curves_options()) : RunningApp(std::move(options), 1600.0f, 2600.0f) {
    model().window().open_sections()["Speed against error"] = true;
  }
  CurvesModel& curves() { return model().curves(); }
  void select(std::uint64_t from, std::uint64_t to) {
    model().time().select_tick(from);
    frame();
    click("plots/cursor_a");
    model().time().select_tick(to);
    frame();
    click("plots/cursor_b");
  }
  void line(const std::string& text) {
    MenuBar menu;
    const auto commands = window_commands(model(), menu);
    const Status done = run_line(commands, text);
    INFO(text);
    CHECK(done);
    frames(3);  // the section opens
    if (!menu.wish.widget.empty()) click(menu.wish.widget);
    frames(2);
  }
  std::string point_path(std::size_t i) { return "speed/point/" + std::to_string(i + 1); }
  /// The point of a method as the preset has it.
  std::size_t preset_point(Method method) {
    const auto shown = curves().curves();
    for (std::size_t i = 0; i < shown->points.size(); ++i)
      if (shown->points[i].setting.method == method && shown->points[i].setting.swept == bench::Swept::nothing)
        return i;
    FAIL("no such point");
    return 0;
  }
  /// A point, not of the preset's method, that no other one covers and no peer: where they lie is a matter of times.
  std::size_t lone_point() {
    const auto shown = curves().curves();
    const auto distance = [&](std::size_t i, std::size_t k) {
      const ItemRect *a = app().items().find(point_path(i)), *b = app().items().find(point_path(k));
      if (a == nullptr || b == nullptr) return a == nullptr ? 0.0f : 1e9f;  // not drawn
      return std::hypot(a->centre().x - b->centre().x, a->centre().y - b->centre().y);
    };
    std::size_t best = 0;
    float most = 0.0f;
    for (std::size_t i = 0; i < shown->points.size(); ++i) {
      if (shown->points[i].setting.method == Method::robust) continue;
      float nearest = 1e9f;
      for (std::size_t k = 0; k < shown->points.size() + shown->peers.size(); ++k)
        if (k != i) nearest = std::min(nearest, distance(i, k));
      if (nearest > most) most = nearest, best = i;
    }
    REQUIRE(most > 1.0f);
    return best;
  }
};

}  // namespace

TEST_CASE("speed against error over A to B - a click on a point opens its worst tick with its method as what-if") {
  CurvesApp ui;
  ui.run(1500);
  ui.select(1000, 1149);
  ui.click("speed/start");
  const auto shown = ui.curves().curves();
  REQUIRE(shown != nullptr);
  CHECK(shown->ticks == 150);
  CHECK(ui.curves().range() == TickRange{1000, 1149});
  CHECK(shown->rounds == bench::kLeastRounds);
  CHECK_FALSE(ui.curves().running());
  CHECK_FALSE(ui.curves().outdated());
  ui.frame();
  for (const char* path : {"speed/plot", "speed/range", "speed/levels", "speed/clear"})
    CHECK(ui.app().items().find(path) != nullptr);

  const std::size_t point = ui.lone_point();
  const Method method = shown->points[point].setting.method;
  const auto tick = ui.curves().worst_tick(point);
  REQUIRE(tick);
  CHECK(*tick >= 1000);
  CHECK(*tick <= 1149);
  ui.click(ui.point_path(point));
  CHECK(ui.model().time().paused());
  CHECK(ui.model().tick_in_view()->tick == *tick);
  CHECK(ui.model().presets().current().solver.method == method);
  CHECK(ui.model().view().toggles.planes);
  ui.frames(3);
  CHECK(ui.model().time().beside().shown());
  CHECK(ui.model().time().beside().preset().solver.method == method);
  CHECK_FALSE(ui.curves().outdated());  // only what is swept has changed
  ui.model().presets().undo();
  CHECK(ui.model().presets().current().solver.method == Method::robust);

  ui.model().presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 0.013);
  CHECK(ui.curves().outdated());
  ui.frame();
  ui.click("speed/clear");
  CHECK(ui.curves().curves() == nullptr);
  CHECK(ui.app().items().find("speed/plot") == nullptr);
}

TEST_CASE("the tolerance and the limit of an opened point become the present ones, a peer's tick leaves the values") {
  CurvesApp ui;
  ui.run(800);
  ui.select(500, 599);
  ui.line("speed start");
  const auto shown = ui.curves().curves();
  REQUIRE(shown != nullptr);
  for (std::size_t i = 0; i < shown->points.size(); i += 7) {
    ui.line("speed point " + std::to_string(i + 1));
    const SolverSettings& solver = ui.model().presets().current().solver;
    CHECK(solver.method == shown->points[i].setting.method);
    CHECK(solver.tolerance_m == shown->points[i].setting.tolerance_m);
    CHECK(solver.max_iterations == shown->points[i].setting.max_iterations);
    CHECK(ui.model().tick_in_view()->tick == *ui.curves().worst_tick(i));
  }
  REQUIRE_FALSE(shown->peers.empty());
  const Preset before = ui.model().presets().current();
  ui.line("speed point " + std::to_string(shown->points.size() + 1));
  CHECK(ui.model().presets().current() == before);
  CHECK(ui.model().tick_in_view()->tick == *ui.curves().worst_tick(shown->points.size()));
  ui.line("speed point 1000");
  CHECK(said(ui.model(), Severity::note, "no such point"));
}

TEST_CASE("the plot shows the error and the time that are chosen, and the pointer on a point says its numbers") {
  CurvesApp ui;
  ui.run(700);
  ui.select(500, 579);
  ui.line("speed start");
  const std::string path = ui.point_path(ui.preset_point(Method::robust));
  ui.line("speed error median");
  ui.line("speed time median");
  const ImVec2 median = ui.centre(path);
  ui.line("speed error worst");
  ui.line("speed time 99");
  CHECK(ui.curves().shown_error == CurvesModel::Error::worst);
  CHECK(ui.curves().shown_time == CurvesModel::Time::p99);
  const ImVec2 worst = ui.centre(path);
  CHECK((median.x != worst.x || median.y != worst.y));
  ui.move(worst);
  test::TextRecorder recorder;
  ui.frame();
  bool numbers = false;
  for (const test::DrawnText& text : recorder.texts()) {
    numbers = numbers || (text.text.find("error: median") != std::string::npos &&
                          text.text.find("Click: open its worst tick") != std::string::npos);
  }
  CHECK(numbers);
}

TEST_CASE("without ticks and in 2D there is nothing to measure, and a message says so") {
  CurvesApp empty;
  empty.curves().start();
  CHECK(said(empty.model(), Severity::note, "no ticks to measure"));
  CHECK(empty.curves().curves() == nullptr);
  empty.curves().open(0);
  CHECK(said(empty.model(), Severity::note, "no such point"));
}

TEST_CASE("a 2D scene has no curves of speed against error, and a message says so") {
  const testing::TempFolder folder;
  AppOptions options = curves_options();
  options.mesh = folder.write("outline.csv", "x_m,y_m\n-0.06,-0.03\n0.055,-0.034\n0.048,0.018\n-0.05,0.034\n");
  CurvesApp ui(options);
  ui.run(300);
  ui.curves().start();
  CHECK(ui.curves().curves() == nullptr);
  CHECK(said(ui.model(), Severity::note, "this scene is 2D"));
}
