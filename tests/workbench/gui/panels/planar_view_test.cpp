// 2D scenes in the window, conditions by name, and the panel "Smoothness as felt".
#include "core/io/rendering_condition.h"
#include "tests/support/approx.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/headless_app.h"

#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

AppOptions options_for(const std::string& mesh) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = mesh;
  return options;
}

}  // namespace

TEST_CASE("a CSV polygon opens as a 2D scene, is explored, and its view pans and zooms about the pointer") {
  const tangent::testing::TempFolder folder;
  HeadlessApp app(options_for(folder.write("arc.csv", "x_m,y_m\n-0.08,0\n-0.04,0.03\n0,0.04\n0.04,0.03\n0.08,0\n")));
  REQUIRE(app.model().scene().current() != nullptr);
  REQUIRE(app.model().scene().current()->planar() != nullptr);
  for (int i = 0; i < 40; ++i) {
    app.app().advance(50);
    app.frame();
  }
  const ServoRecord* record = app.model().time().tick().record();
  REQUIRE(record != nullptr);
  CHECK(record->tick.output.status != TickStatus::unconverged);
  CHECK(record->tick.output.contact.z == 0.0);
  CHECK(app.model().time().tick().iterations().size() >= 1);
  for (const char* toggle : {"Patches", "Centres", "Tangents"}) app.click(std::string("planar/") + toggle);
  app.wheel(app.centre("view"), 3.0f);
  app.drag("view", {60.0f, 20.0f});
  app.key('F');
  app.model().map().on = true;  // nothing to lay a map on
  app.frames(3);
  app.model().scene().set_crease_angle(0.1);
  app.frames(2);
  CHECK(app.model().scene().current()->planar() != nullptr);
}

TEST_CASE("the inset keeps off a polygon, and F frames it again and again") {
  const tangent::testing::TempFolder folder;
  const std::string file =
      folder.write("box.csv", "x_m,y_m\n-0.06,-0.02\n0.06,-0.02\n0.06,0.03\n-0.06,0.03\n-0.06,-0.02\n");
  for (const auto& [width, height] : {std::pair{1280.0f, 720.0f}, {2560.0f, 1440.0f}, {900.0f, 900.0f}}) {
    CAPTURE(width);
    HeadlessApp app(options_for(file), width, height);
    app.app().advance(200);
    app.frames(2);
    const auto outline = [&] { return *app.app().items().find("planar/outline"); };
    const ItemRect framed = outline(), inset = *app.app().items().find("planar/inset");
    CHECK((framed.min.x >= inset.max.x || framed.max.y <= inset.min.y));
    CHECK(framed.min.y >= app.app().items().find("planar/Display")->max.y);
    CHECK(framed.max.x - framed.min.x >
          0.25f * (app.app().items().find("view")->max.x - app.app().items().find("view")->min.x));
    for (int again = 0; again < 2; ++again) {
      app.drag("view", {60.0f, 20.0f});
      CHECK(outline().min.x == approx(framed.min.x + 60.0f));
      app.key('F');
      CHECK(outline().min.x == approx(framed.min.x));
    }
  }
}

TEST_CASE("a polygon that is none leaves the scene as it was and says why") {
  const tangent::testing::TempFolder folder;
  HeadlessApp app;
  app.model().scene().open(folder.write("bad.csv", "x_m,y_m\n0,0\n1,1\n1,0\n0,1\n"));
  app.frames(2);
  CHECK(app.model().scene().current()->planar() == nullptr);
  REQUIRE_FALSE(app.model().messages().all().empty());
  CHECK(app.model().messages().all().back().text.find("crosses or touches itself") != std::string::npos);
}

TEST_CASE("choosing a condition sets both sources in one step of undo") {
  HeadlessApp app(HeadlessApp::deterministic_options(), 1280.0f, 1600.0f);
  app.click("force/condition");
  app.click("force/condition/C4");
  CHECK(condition_of(app.model().presets().current()) == find_condition("C4"));
  app.model().presets().undo();
  CHECK(condition_of(app.model().presets().current()) == nullptr);
}

TEST_CASE("the panel on smoothness gives the verdict, and its button the heat map with the threshold marked" *
          doctest::skip(testing::kSanitized)) {
  HeadlessApp app(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  REQUIRE(app.model().scene().perception() != nullptr);
  CHECK(app.model().scene().perception()->curve_edges == 480);
  CHECK(app.app().items().find("perception/verdict") != nullptr);
  app.click("perception/map");
  CHECK(app.model().map().on);
  CHECK(app.model().map().quantity == MapQuantity::facet_angle);
  CHECK(app.model().map().automatic_range());
  CHECK(*app.model().map().limit() == approx(0.2 * kDegree));
  app.click("perception/worst/0");
  CHECK(app.model().view().picked_triangle == app.model().scene().perception()->conditions[2].worst[0].triangle);
  app.click("perception/condition");
  app.click("perception/condition/P1: " + std::string(find_condition("P1")->words));
  CHECK(*app.model().map().limit() == approx(14.8 * kDegree));
  CHECK(app.model().map().statistics().share_beyond_limit < 0.5);
  REQUIRE(app.app().items().find("view/map_bar/limit") != nullptr);
  const ItemRect bar = *app.app().items().find("view/map_bar");
  CHECK(app.app().items().find("view/map_bar/limit")->max.y < bar.max.y);
  CHECK(app.app().items().find("view/map_bar/limit")->min.y > bar.min.y);
}
