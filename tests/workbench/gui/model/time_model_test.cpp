// Time in the window: bookmarks, triggers, marks, the past solved again. Checks the model's state.
#include "tests/workbench/gui/headless_app.h"

#include <cmath>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

struct TimeApp : HeadlessApp {
  using HeadlessApp::HeadlessApp;
  explicit TimeApp(float height = 1600.0f) : HeadlessApp(deterministic_options(), 1600.0f, height) {}
  void run(std::uint64_t ticks) {
    app().advance(ticks);
    frames(2);
  }
  void set(std::string_view key, double value) { model().presets().set_value(*find_preset_key("solver", key), value); }
  std::uint64_t tick() { return model().time().tick().record()->tick.tick; }
};

}  // namespace

TEST_CASE("K sets a bookmark on the tick in view, [ and ] go from one to the next, a note is typed") {
  TimeApp ui;
  ui.run(1000);
  ui.model().time().bookmarks().clear_automatic();
  ui.model().time().select_tick(300);
  ui.frame();
  ui.key('K');
  ui.model().time().select_tick(700);
  ui.frame();
  ui.click("transport/bookmark");
  REQUIRE(ui.model().time().bookmarks().all().size() == 2);
  ui.key('[');
  CHECK(ui.tick() == 300);
  ui.key('[');  // there is none before
  CHECK(ui.tick() == 300);
  ui.click("transport/bookmark_on");
  CHECK(ui.tick() == 700);
  ui.click("transport/bookmark_back");
  CHECK(ui.tick() == 300);
  const std::uint32_t id = ui.model().time().bookmarks().all()[0].id;
  ui.model().window().show_section("Bookmarks", false);
  ui.frames(3);
  ui.click("bookmarks/note/" + std::to_string(id));
  ui.type("first touch");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().time().bookmarks().find(id)->note == "first touch");
  ui.click("bookmarks/row/1");
  CHECK(ui.tick() == 700);
  ui.click("bookmarks/remove/0");
  REQUIRE(ui.model().time().bookmarks().all().size() == 1);
  CHECK(ui.model().time().bookmarks().all()[0].tick == 700);
}

TEST_CASE("triggers bookmark what they were told to, with the thresholds of the panel") {
  TimeApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.0);
  ui.model().time().bookmarks().triggers.iterations_over = 3;
  ui.model().time().bookmarks().triggers.on[static_cast<std::size_t>(BookmarkKind::reseeded)] = false;
  ui.run(3000);
  bool iterations = false;
  for (const Bookmark& b : ui.model().time().bookmarks().all()) {
    CHECK(b.kind != BookmarkKind::reseeded);
    if (b.kind != BookmarkKind::iterations) continue;
    iterations = true;
    CHECK(ui.model().devices().session()->history().find(b.tick)->tick.output.iterations > 3);
  }
  CHECK(iterations);
  ui.model().window().set_task(Task::record);
  ui.frame();
  ui.click("bookmarks/triggers");
  ui.frame();
  ui.click("bookmarks/trigger/reseeded");
  CHECK(ui.model().time().bookmarks().triggers.on[static_cast<std::size_t>(BookmarkKind::reseeded)]);
  ui.click("bookmarks/iterations_over");
  ui.frame();
  ui.type("12");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().time().bookmarks().triggers.iterations_over == 12);
  ui.click("bookmarks/clear");
  CHECK(ui.model().time().bookmarks().all().empty());
}

TEST_CASE("a gain changed on the paused past brings a ghost of all of it - back to the old value, none - live, none") {
  TimeApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.run(2500);
  ui.click("transport/pause");
  REQUIRE(ui.model().time().time_machine().verified());
  CHECK(ui.model().time().time_machine().verified()->numbers.different_ticks == 0);
  CHECK(ui.model().time().ghost() == nullptr);
  const double gain = ui.model().presets().current().solver.gain_curvature_m;
  ui.drag("solver/gain_curvature_m", {-40.0f, 0.0f});
  REQUIRE(ui.model().time().ghost() != nullptr);
  CHECK(ui.model().time().ghost()->preset.solver.gain_curvature_m ==
        ui.model().presets().current().solver.gain_curvature_m);
  CHECK(ui.model().time().ghost()->numbers.resolved.ticks == 2500);
  CHECK(ui.model().time().ghost()->numbers.resolved.mean_iterations >
        ui.model().time().ghost()->numbers.recorded.mean_iterations);
  CHECK(ui.app().items().find("time_machine/same_motion") != nullptr);
  ui.set("gain_curvature_m", gain);
  ui.frame();
  CHECK(ui.model().time().ghost() == nullptr);
  ui.click("time_machine/solve");  // asked for: unchanged gains
  REQUIRE(ui.model().time().ghost() != nullptr);
  // The first ticks ran before the method reached the servo; the rest under these very values.
  CHECK(ui.model().time().ghost()->numbers.different_ticks == 0);
  ui.click("transport/live");
  CHECK(ui.model().time().ghost() == nullptr);
  CHECK_FALSE(ui.model().time().time_machine().is_open());
}

TEST_CASE("the list of changed contacts leads to their ticks") {
  TimeApp ui(2400.0f);
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.02);
  ui.model().scene().open("torus");
  ui.run(8000);
  ui.click("transport/pause");
  ui.set("gain_curvature_m", 0.0);
  ui.frames(2);
  REQUIRE(ui.model().time().ghost() != nullptr);
  const auto& changes = ui.model().time().ghost()->numbers.changes;
  REQUIRE_FALSE(changes.empty());
  ui.click("time_machine/change/0");
  CHECK(ui.tick() == changes[0].worst_tick);
}

TEST_CASE("every change of a parameter is marked at the tick it was applied") {
  TimeApp ui;
  ui.run(400);
  CHECK(ui.model().time().parameter_marks().empty());
  ui.set("gain_overall", 0.5);
  ui.run(400);
  ui.set("gain_curvature_m", 0.013);
  ui.run(400);
  REQUIRE(ui.model().time().parameter_marks().size() == 2);
  CHECK(ui.model().time().parameter_marks()[0].tick == 400);
  CHECK(ui.model().time().parameter_marks()[1].tick == 800);
  CHECK(ui.model().time().parameter_marks()[0].text.find("0.5") != std::string::npos);
  CHECK(ui.model().time().parameter_marks()[1].text.find("13 mm") != std::string::npos);
}

TEST_CASE("scrubbing in the strip moves the one time cursor - nothing of the recording stops") {
  TimeApp ui;
  ui.run(3000);
  const ItemRect strip = *ui.app().items().find("transport/strip");
  const auto scrub_to = [&](float share) {
    ui.move({strip.min.x + share * (strip.max.x - strip.min.x), strip.centre().y});
    ui.press();
    ui.frame();
    ui.release();
  };
  scrub_to(0.02f);
  REQUIRE(ui.model().time().paused());
  const std::uint64_t first = ui.tick();
  scrub_to(0.06f);
  CHECK(ui.tick() > first);
  CHECK(ui.model().time().tick().iterations().size() >= 1);
  const std::uint64_t seen = ui.tick();
  ui.run(500);
  CHECK(ui.tick() == seen);
  CHECK(ui.model().time().end_tick() == 3500);
}

TEST_CASE("the zoom stays when the view goes back to live") {
  TimeApp ui;
  ui.run(3000);
  ui.click("transport/pause");
  ui.wheel(ui.centre("plots/force"), 3.0f);
  const double span = ui.model().time().axis().span();
  CHECK(span < 5000.0);
  ui.click("transport/live");
  CHECK(ui.model().time().axis().following());
  CHECK(ui.model().time().axis().span() == span);
}

TEST_CASE("a box in a plot zooms time, and values when it is high - each axis can be moved alone") {
  TimeApp ui;
  ui.run(3000);
  ui.click("transport/pause");
  const double whole = ui.model().time().axis().span();
  ui.drag("plots/force", {120.0f, 2.0f}, 1);
  const double boxed = ui.model().time().axis().span();
  CHECK(boxed < 0.6 * whole);
  const double from = ui.model().time().axis().from();
  ui.drag("plots/force/values", {0.0f, 15.0f});
  CHECK(ui.model().time().axis().from() == from);
  const double to = ui.model().time().axis().to();
  ui.drag("plots/force/time", {-20.0f, 0.0f});
  CHECK(ui.model().time().axis().to() > to);
  CHECK(ui.model().time().axis().span() == boxed);
  ui.wheel(ui.centre("plots/force/time"), 1.0f);
  CHECK(ui.model().time().axis().span() < boxed);
}

TEST_CASE("a click on a plane's point in the 3D view selects its row, and the row its point") {
  TimeApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.002);
  ui.run(2500);
  ui.click("transport/pause");
  const auto iterations = ui.model().time().tick().iterations();
  REQUIRE(iterations.size() >= 2);
  Camera& camera = ui.model().view().camera;
  camera.target = iterations[0].point;
  camera.distance_m = 8.0 * std::max(1e-5, glm::length(iterations[0].point - iterations[1].point));
  const ItemRect rect = *ui.app().items().find("view");
  const int w = static_cast<int>(rect.max.x - rect.min.x), h = static_cast<int>(rect.max.y - rect.min.y);
  const auto click_plane = [&](std::size_t i) {
    const Vec3 p = camera.project(iterations[i].point, w, h);
    ui.move({rect.min.x + static_cast<float>(p.x), rect.min.y + static_cast<float>(p.y)});
    ui.press();
    ui.release();
    ui.frame();
  };
  click_plane(0);
  CHECK(ui.model().time().tick().selected() == std::size_t{0});
  click_plane(1);
  CHECK(ui.model().time().tick().selected() == std::size_t{1});
  CHECK(ui.model().view().picked_triangle == kNone);
  click_plane(1);
  CHECK_FALSE(ui.model().time().tick().selected().has_value());
}

TEST_CASE("the fan holds the ticks up to the one in view, each as it is stepped again") {
  TimeApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.run(1000);
  ui.model().time().select_tick(500);
  for (const std::uint64_t tick : {500u, 503u, 900u, 20u}) {
    ui.model().time().select_tick(tick);
    const auto& curves = ui.model().time().error_fan().curves();
    REQUIRE(curves.size() == std::min<std::size_t>(ErrorFan::kTicks, tick + 1));
    CHECK(curves.back().tick == tick);
    CHECK(curves.front().tick == tick + 1 - curves.size());
    for (const ErrorFan::Curve& curve : curves) {
      const ServoRecord& record = *ui.model().devices().session()->history().find(curve.tick);
      REQUIRE_FALSE(curve.error_m.empty());
      CHECK(curve.error_m.back() == static_cast<float>(record.tick.output.error_m));
    }
  }
}

TEST_CASE("a click on a dot of the path map selects that plane") {
  TimeApp ui;
  ui.set("method", static_cast<double>(Method::paper));
  ui.set("gain_curvature_m", 0.002);
  ui.run(2500);
  ui.click("transport/pause");
  CHECK(ui.app().items().find("iterations/path_map") != nullptr);
  ui.click("iterations/map_triangle");
  ui.click("iterations/map_path");
  const ItemRect map = *ui.app().items().find("iterations/path_map");
  // The view is as wide as the path: somewhere on a fine raster there is a dot.
  for (float y = map.min.y + 4.0f; y < map.max.y && !ui.model().time().tick().selected(); y += 12.0f) {
    for (float x = map.min.x + 4.0f; x < map.max.x && !ui.model().time().tick().selected(); x += 12.0f) {
      ui.move({x, y});
      ui.press();
      ui.release();
    }
  }
  CHECK(ui.model().time().tick().selected().has_value());
}

TEST_CASE(
    "the error plot has room for the tick in view where time stands still, and for all of the fan while it runs") {
  CHECK(iterations_shown(3, 40, true) == 5);
  CHECK(iterations_shown(22, 40, true) == 22);
  CHECK(iterations_shown(3, 40, false) == 40);
  CHECK(iterations_shown(50, 40, false) == 50);
  CHECK(iterations_shown(0, 0, false) == 5);
}
