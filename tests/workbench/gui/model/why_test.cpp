// Why this tick, in the window: cause and cure of the tick in view, and what a person can do about it.
#include "tests/support/approx.h"
#include "tests/workbench/gui/running_app.h"

#include <chrono>
#include <thread>

using namespace tangent;
using namespace tangent::test;
using tangent::test::RunningApp;
using tangent::test::said;

namespace {

/// Ticks under a gain that is too small, paused on the one with most planes.
struct WhyApp : RunningApp {
  explicit WhyApp(bool deterministic = true) : RunningApp(options(deterministic), 1600.0f, 3200.0f) {}
  static AppOptions options(bool deterministic) {
    AppOptions options = deterministic_options();
    options.mesh = "torus";
    options.deterministic = deterministic;
    return options;
  }
  void run_badly() {
    set("method", static_cast<double>(Method::paper));
    set("gain_overall", 0.1);
    run();
    std::uint64_t busiest = 0;
    std::size_t most = 0;
    for (std::uint64_t tick = 200; tick < model().time().end_tick(); tick += 7) {
      model().time().select_tick(tick);
      const std::size_t planes = model().time().tick().iterations().size();
      if (planes > most) most = planes, busiest = tick;
    }
    REQUIRE(most > 9);
    model().time().select_tick(busiest);
    frame();
  }
  void set(std::string_view key, double value) { model().presets().set_value(*find_preset_key("solver", key), value); }
};

}  // namespace

TEST_CASE("the cause of the tick in view is what explain_tick tells of it, and none is told while live") {
  WhyApp ui;
  ui.run_badly();
  const Why* why = ui.model().why().of_tick_in_view();
  REQUIRE(why != nullptr);
  CHECK(why->told.cause == TickCause::gain_too_small);
  const ServoRecord& record = *ui.model().time().tick().record();
  const TickExplanation alone = explain_tick(ui.model().time().scene_of_tick(), *ui.model().time().preset_of_tick(),
                                             record.tick.input, record.tick.kept);
  CHECK(explanation_text(why->told) == explanation_text(alone));
  CHECK(ui.app().items().find("why/cause") != nullptr);
  CHECK(ui.app().items().find("why/cure") != nullptr);
  ui.model().time().go_live();
  ui.frame();
  CHECK(ui.model().why().of_tick_in_view() == nullptr);
  CHECK(ui.app().items().find("why/cause") == nullptr);
  ui.model().why().set_cure();
  CHECK(said(ui.model(), Severity::note, "pause on a tick first"));
}

TEST_CASE("of a tick with which nothing is wrong nothing else is said") {
  WhyApp ui;
  ui.run();
  std::uint64_t plain = 0;
  for (std::uint64_t tick = 200; tick < ui.model().time().end_tick() && plain == 0; tick += 7) {
    ui.model().time().select_tick(tick);
    if (ui.model().why().of_tick_in_view()->told.cause == TickCause::nothing) plain = tick;
  }
  REQUIRE(plain > 0);
  ui.model().why().try_cure();
  CHECK(said(ui.model(), Severity::note, "nothing is wrong with this tick"));
  CHECK_FALSE(said(ui.model(), Severity::note, "no value of a parameter"));
}

TEST_CASE("a cure is tried as a ghost that leaves the preset alone, and set as one step of undo") {
  WhyApp ui;
  ui.run_badly();
  const TickCure cure = ui.model().why().of_tick_in_view()->told.cure;
  REQUIRE(cure.outcome == CureOutcome::found);
  const Preset before = ui.model().presets().current();
  ui.click("why/try");
  CHECK(ui.model().presets().current() == before);
  REQUIRE(ui.model().time().ghost() != nullptr);
  CHECK(cure.key->get(ui.model().time().ghost()->preset) == cure.to);
  REQUIRE(ui.model().time().time_machine().compared() != nullptr);
  CHECK(ui.model().time().time_machine().compared()->after_numbers.mean_iterations <
        ui.model().time().time_machine().compared()->before_numbers.mean_iterations);
  ui.click("why/set");
  CHECK(cure.key->get(ui.model().presets().current()) == approx(cure.to));
  ui.model().presets().undo();
  CHECK(ui.model().presets().current() == before);
}

TEST_CASE("a click on the place of a cause turns the camera there and picks the triangle") {
  WhyApp ui;
  ui.run_badly();
  const MeshPlace place = ui.model().why().of_tick_in_view()->told.mesh;
  REQUIRE(place.triangle != kNone);
  ui.model().view().picked_triangle = kNone;
  ui.click("why/go");
  CHECK(ui.model().view().picked_triangle == place.triangle);
  CHECK(ui.model().view().camera.target == place.place);
}

TEST_CASE("the window asks and goes on, and the newest question is answered by another thread") {
  WhyApp ui(false);
  for (int i = 0; i < 400 && ui.model().time().end_tick() < 300; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ui.frame();
  }
  REQUIRE(ui.model().time().end_tick() >= 300);
  for (const std::uint64_t tick : {100, 150, 200}) ui.model().time().select_tick(tick), ui.frame();
  const Why* why = nullptr;
  for (int i = 0; i < 1000 && (why = ui.model().why().of_tick_in_view()) == nullptr; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  REQUIRE(why != nullptr);
  CHECK(why->asked.tick == ui.model().time().tick().record()->tick.tick);
  CHECK_FALSE(ui.model().why().looking());
}
