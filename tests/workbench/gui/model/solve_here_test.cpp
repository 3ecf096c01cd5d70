// A tick at a place without waiting for the finger: from the map, a picked triangle, a bookmark.
#include "tests/workbench/gui/headless_app.h"

#include <algorithm>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

struct PlaceApp : HeadlessApp {
  PlaceApp() : HeadlessApp(options(), 1600.0f, 2400.0f) {
    set("method", static_cast<double>(Method::paper));
    set("gain_curvature_m", 0.004);
    app().advance(1500);
    frames(2);
  }
  static AppOptions options() {
    AppOptions options = deterministic_options();
    options.mesh = "torus";
    return options;
  }
  void set(std::string_view key, double value) { model().presets().set_value(*find_preset_key("solver", key), value); }
  TimeModel& time() { return model().time(); }
};

}  // namespace

TEST_CASE("H solves at the picked triangle, in the direction that needs most planes, with its planes in view") {
  PlaceApp ui;
  ui.model().view().picked_triangle = 77;
  ui.model().view().toggles.planes = false;
  ui.key('H');
  REQUIRE(ui.time().placed() != nullptr);
  const PlacedTick& placed = *ui.time().placed();
  CHECK(placed.triangle() == 77);
  CHECK(ui.time().paused());
  CHECK(ui.model().view().toggles.planes);
  const auto planes = [&](std::size_t i) { return placed.moves()[i].output.iterations; };
  for (std::size_t i = 0; i < placed.moves().size(); ++i) CHECK(planes(i) <= planes(placed.chosen()));
  CHECK(ui.time().tick().record()->tick.output.iterations == planes(placed.chosen()));
  CHECK(static_cast<int>(ui.time().tick().iterations().size()) == planes(placed.chosen()) + 1);
  CHECK(ui.time().tick().iterations().front().triangle == 77);
  ui.frame();
  CHECK(ui.app().items().find("iterations/place") != nullptr);
  ui.click("iterations/move/8");  // straight in
  CHECK(ui.time().placed()->chosen() == 8);
  CHECK(ui.time().tick().record()->tick.output.iterations == planes(8));
}

TEST_CASE("a gain dragged at a place shows its planes beside those before - a step in time leaves the place") {
  PlaceApp ui;
  ui.time().select_tick(900);
  ui.model().view().picked_triangle = 300;
  ui.frame();
  ui.click("iterations/solve_here");
  REQUIRE(ui.time().placed() != nullptr);
  CHECK_FALSE(ui.time().beside().shown());
  const int before = ui.time().tick().record()->tick.output.iterations;
  ui.set("gain_curvature_m", 0.020);
  ui.frame();
  REQUIRE(ui.time().beside().shown());
  CHECK(ui.time().tick().record()->tick.output.iterations == before);
  CHECK(ui.time().beside().output().iterations < before);
  ui.click("iterations/leave_place");
  CHECK(ui.time().placed() == nullptr);
  CHECK(ui.time().tick().record()->tick.tick == 900);
  ui.key('H');
  ui.key(HeadlessApp::kRight);
  CHECK(ui.time().placed() == nullptr);
  CHECK(ui.time().tick().record()->tick.tick == 901);
  ui.key('H');
  ui.key(HeadlessApp::kEnd);
  CHECK(ui.time().placed() == nullptr);
  CHECK_FALSE(ui.time().paused());
}

TEST_CASE("W goes through the map's worst places, each with its planes") {
  PlaceApp ui;
  ui.model().map().on = true;
  ui.model().map().set_quantity(MapQuantity::iterations_worst);
  ui.frames(3);
  REQUIRE(ui.model().map().worst().size() >= 2);
  for (const std::size_t i : {0u, 1u}) {
    ui.key('W');
    REQUIRE(ui.time().placed() != nullptr);
    const MapPlace& place = ui.model().map().worst()[i];
    CHECK(ui.time().placed()->triangle() == place.triangle);
    CHECK(static_cast<double>(ui.time().tick().record()->tick.output.iterations) == place.value);
  }
  ui.model().window().show_section("Map", false);
  ui.frames(3);
  ui.click("map/worst/0");
  CHECK(ui.time().placed()->triangle() == ui.model().map().worst()[0].triangle);
}

TEST_CASE("a bookmark's place is solved in its worst direction") {
  PlaceApp ui;
  std::uint64_t touching = 0;
  for (std::uint64_t t = 400; t < 1500 && touching == 0; ++t) {
    ui.time().select_tick(t);
    if (ui.time().tick().record()->tick.output.status == TickStatus::face) touching = t;
  }
  REQUIRE(touching > 0);
  ui.time().select_tick(touching);
  ui.frame();
  ui.key('K');
  const TickOutput out = ui.time().tick().record()->tick.output;
  ui.click("bookmarks/solve");
  REQUIRE(ui.time().placed() != nullptr);
  CHECK(ui.time().placed()->triangle() == out.triangle);
  CHECK(ui.time().placed()->u() == out.u);
  CHECK(ui.time().placed()->v() == out.v);
  const std::size_t marks = ui.time().bookmarks().all().size();
  ui.key('K');
  CHECK(ui.time().bookmarks().all().size() == marks);
}
