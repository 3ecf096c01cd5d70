#include "workbench/gui/model/polygon_facts.h"

#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/headless_app.h"

#include "core/io/polygon_io.h"
#include "tests/support/approx.h"

using namespace tangent;
using namespace tangent::test;
using tangent::testing::TempFolder;

namespace {

/// A rectangle of 40 mm x 30 mm whose last vertex is sharp.
PlanarPolygon rectangle(bool closed) {
  return {"rectangle.csv", {{0.0, 0.0}, {0.04, 0.0}, {0.04, 0.03}, {0.0, 0.03}, {0.0, 0.03}}, closed};
}

}  // namespace

TEST_CASE("a polygon's vertices, segments and corners are counted as one sees them") {
  const PolygonFacts closed = facts_of(rectangle(true)), open = facts_of(rectangle(false));
  CHECK(closed.vertices == 4);
  CHECK(closed.corners == 1);
  CHECK(closed.segments == 4);
  CHECK(closed.length_m == approx(0.14));
  CHECK(closed.size_m.x == approx(0.04));
  CHECK(closed.size_m.y == approx(0.03));
  CHECK(open.vertices == 4);
  CHECK(open.segments == 3);
  CHECK(open.length_m == approx(0.11));
  CHECK(facts_of({}).vertices == 0);
}

TEST_CASE("the panels describe a 2D scene's polygon, not the ribbon it is drawn with") {
  const TempFolder folder;
  const auto file = folder.path() / "rectangle.csv";
  REQUIRE(write_polygon(rectangle(true), file));
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = file.string();
  HeadlessApp ui(options, 1920.0f, 1080.0f);
  for (const char* title : {"Iterations", "Smoothness as felt"}) ui.model().window().open_sections()[title] = false;
  for (const char* title : {"Mesh", "Inspect"}) ui.model().window().open_sections()[title] = true;
  ui.frames(3);
  REQUIRE(ui.model().scene().current()->planar() != nullptr);
  CHECK(ui.app().items().find("mesh/segments") != nullptr);
  CHECK(ui.app().items().find("mesh/triangles") == nullptr);
  CHECK(ui.app().items().find("inspect/slice") == nullptr);
  ui.model().scene().open("torus");
  ui.frames(3);
  CHECK(ui.app().items().find("mesh/segments") == nullptr);
  CHECK(ui.app().items().find("mesh/triangles") != nullptr);
  CHECK(ui.app().items().find("inspect/slice") != nullptr);
}
