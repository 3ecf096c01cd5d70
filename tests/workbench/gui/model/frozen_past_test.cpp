// The past in view is not lost while one looks at it: pause, bookmarks and the selection keep their ticks.
#include "tests/workbench/gui/headless_app.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

/// Four seconds of history.
struct ShortHistory : HeadlessApp {
  ShortHistory() : HeadlessApp(options(), 1600.0f, 1600.0f) {}
  static AppOptions options() {
    AppOptions options = deterministic_options();
    options.history_s = 4.0;
    return options;
  }
  void run(std::uint64_t ticks) {
    for (; ticks > 0; ticks -= std::min<std::uint64_t>(ticks, 1000))
      app().advance(std::min<std::uint64_t>(ticks, 1000));
    frames(2);
  }
  TimeModel& time() { return model().time(); }
  std::uint64_t tick() { return time().tick().record()->tick.tick; }
  void clear_marks() { time().bookmarks().clear_automatic(); }
  /// Every tick that the plots draw can be chosen, and its planes computed.
  void check_reachable() {
    REQUIRE(time().end_tick() > time().first_tick());
    const std::uint64_t step = std::max<std::uint64_t>(1, (time().end_tick() - time().first_tick()) / 40);
    for (std::uint64_t t = time().first_tick(); t < time().end_tick(); t += step) {
      time().select_tick(t);
      CHECK(tick() == t);
      CHECK_FALSE(time().tick().iterations().empty());
      CHECK(time().tick().iterations().back().error_m == time().tick().record()->tick.output.error_m);
    }
  }
};

}  // namespace

TEST_CASE("looking at a tick for longer than the history lasts loses nothing: steps, plots and bookmarks stay") {
  ShortHistory ui;
  ui.run(3000);
  ui.clear_marks();
  ui.time().select_tick(700);
  ui.time().add_bookmark();
  ui.time().select_tick(2000);
  ui.run(20'000);
  CHECK(ui.model().devices().session()->history().oldest().tick.tick > 10'000);
  ui.key(HeadlessApp::kRight);
  CHECK(ui.tick() == 2001);
  ui.key('[');
  CHECK(ui.tick() == 700);
  CHECK(ui.time().store().first_tick() == 0);
  CHECK(ui.time().frozen_bytes() >= 3000 * sizeof(ServoRecord));
  CHECK(ui.app().items().find("transport/frozen") != nullptr);
  ui.check_reachable();
  CHECK(ui.time().newest_recorded() == 22'999);
}

TEST_CASE("live again after a long pause: the newest ticks, and nothing drawn that is forgotten") {
  ShortHistory ui;
  ui.run(3000);
  ui.click("transport/pause");
  ui.run(20'000);
  ui.click("transport/live");
  const History& history = ui.model().devices().session()->history();
  CHECK(ui.tick() == 22'999);
  CHECK(ui.time().first_tick() == history.oldest().tick.tick);
  CHECK(ui.time().end_tick() == 23'000);
  CHECK(ui.time().frozen_bytes() == 0);
  ui.check_reachable();
}

TEST_CASE("while live the plots end where the history does, whatever room they have") {
  ShortHistory ui;
  ui.run(9000);
  CHECK(ui.time().first_tick() == ui.model().devices().session()->history().oldest().tick.tick);
  CHECK(std::isnan(ui.time().store().value(0, ui.time().first_tick() - 1)));
}

TEST_CASE("a person's bookmark keeps the ticks around it when the history has moved on, and its ghost") {
  ShortHistory ui;
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.run(2000);
  ui.time().select_tick(1200);
  ui.time().add_bookmark();
  ui.clear_marks();
  ui.time().go_live();
  ui.run(20'000);
  ui.clear_marks();
  CHECK(ui.time().frozen_bytes() > 0);
  CHECK(ui.time().frozen_bytes() <= 2 * 1024 * sizeof(ServoRecord));
  ui.key('[');
  REQUIRE(ui.tick() == 1200);
  CHECK(ui.time().first_tick() == 700);
  CHECK(ui.time().end_tick() == 1301);
  ui.check_reachable();
  ui.model().presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 0.002);
  REQUIRE(ui.time().ghost() != nullptr);
  CHECK(ui.time().ghost()->numbers.resolved.ticks == 601);
  ui.time().go_live();
  CHECK(ui.tick() == 21'999);
  ui.time().bookmarks().remove(ui.time().bookmarks().all()[0].id);
  ui.frame();
  ui.run(1);
  CHECK(ui.time().frozen_bytes() == 0);
}

TEST_CASE("the ticks from cursor A to B are kept") {
  ShortHistory ui;
  ui.run(3000);
  ui.time().select_tick(1400);
  ui.frame();
  ui.click("plots/cursor_a");
  ui.time().select_tick(1000);
  ui.frame();
  ui.click("plots/cursor_b");
  CHECK(ui.time().selection() == TickRange{1000, 1400});
  ui.time().go_live();
  ui.run(20'000);
  REQUIRE(ui.time().run_over({1000, 1400}));
  const RunPart part = *ui.time().run_over({1000, 1400});
  CHECK(part.run.records.newest().tick.tick == 1400);
  CHECK(part.run.records[part.first].tick.tick == 1000);
  CHECK(part.first == RecordedPast::kLeadIn);
  CHECK_FALSE(ui.time().run_over({1000, 1401}));
  CHECK(ui.time().chosen_range() == TickRange{1000, 1400});
  ui.click("time_machine/selection");
  CHECK(ui.tick() == 1000);
  ui.check_reachable();
  ui.time().go_live();
  ui.frame();
  ui.click("plots/cursor_a");
  CHECK_FALSE(ui.time().run_over({1000, 1400}));
}

TEST_CASE("triggers don't remove bookmarks of the paused past, neither by number nor by age") {
  ShortHistory ui;
  BookmarkTriggers& triggers = ui.time().bookmarks().triggers;
  triggers.on.fill(false);
  triggers.on[static_cast<std::size_t>(BookmarkKind::iterations)] = true;
  triggers.iterations_over = 0;
  ui.run(3000);
  REQUIRE_FALSE(ui.time().bookmarks().all().empty());
  const auto first = ui.time().bookmarks().all().front();
  ui.time().set_paused(true);
  ui.run(20'000);
  REQUIRE_FALSE(ui.time().bookmarks().all().empty());
  CHECK(ui.time().bookmarks().all().front().id == first.id);
  for (const Bookmark& mark : ui.time().bookmarks().all()) CHECK(ui.time().past().reaches(mark.tick));
}

TEST_CASE("a mesh opened while the past is frozen leaves the old ticks solvable") {
  ShortHistory ui;
  ui.run(2000);
  ui.time().select_tick(900);
  ui.model().scene().open("torus");
  ui.run(20'000);
  ui.time().select_tick(901);
  CHECK(ui.tick() == 901);
  CHECK(ui.time().tick().problem().empty());
  CHECK_FALSE(ui.time().tick().iterations().empty());
}
