#include "core/io/polygon_io.h"
#include "core/lab/objects/arc.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

std::string csv_error(const std::string& rows) {
  const auto polygon = parse_polygon_csv("x_m,y_m\n" + rows, "p.csv");
  return polygon ? "no error" : polygon.error().message();
}
std::string obj_error(const std::string& text) {
  const auto polygon = parse_polygon_obj(text, "p.obj", 1e-3);
  return polygon ? "no error" : polygon.error().message();
}
bool has(const std::string& text, const std::string& part) {
  INFO(text);
  const bool found = text.find(part) != std::string::npos;
  CHECK(found);
  return found;
}

}  // namespace

TEST_CASE("a CSV polygon is open, or closed when its first vertex comes again at the end") {
  const auto open = parse_polygon_csv("x_m,y_m\n0,0\n0.1,0\n0.1,0.1\n", "p.csv");
  REQUIRE(open);
  CHECK_FALSE(open->closed);
  CHECK(open->vertices.size() == 3);
  const auto closed = parse_polygon_csv("x_m,y_m\r\n0,0\r\n0.1,0\r\n0.1,0.1\r\n0,0\r\n", "p.csv");
  REQUIRE(closed);
  CHECK(closed->closed);
  CHECK(closed->vertices.size() == 3);
}

TEST_CASE("an OBJ polyline takes its unit, several elements in a chain, and indices from the end") {
  const auto polygon =
      parse_polygon_obj("# a line\nv 0 0 5\nv 10 0 5\nv 10 10 5\nv 0 10 5\nl 1 2 3\nl 3 -1\n", "p.obj", 1e-3);
  REQUIRE_MESSAGE(polygon, (polygon ? "" : polygon.error().message()));
  CHECK(polygon->vertices.size() == 4);
  CHECK(polygon->vertices[2] == Vec2(0.01, 0.01));
}

TEST_CASE("bad polygons are refused with what, where and what to do") {
  has(csv_error("0,0\n0.1,0\n"), "only 2 different vertices");
  has(csv_error("0,0\n0,0\n0,0\n"), "only 1 different vertex");
  has(csv_error("0,0\n0.1,0\n0.1,0\n0.1,0\n0.2,0.1\n"), "vertex 1 is there three times or more in a row");
  has(csv_error("0,0\n0,0\n0.1,0\n0.2,0.1\n"), "the first vertex is repeated");
  has(csv_error("0,0\n0.1,nan\n0.2,0\n"), "p.csv:3: y_m is \"nan\"");
  has(csv_error("0,0\ninf,0\n0.2,0\n"), "p.csv:3: x_m is \"inf\"");
  has(csv_error("0\n0.1\n"), "p.csv:2: only one column");
  has(csv_error("0,0,0\n0.1,0,0\n"), "p.csv:2: more columns than the header names");
  has(csv_error("0,0\n0.1,0.1\n0.1,0\n0,0.1\n"), "crosses or touches itself: the segments after vertices 0 and 2");
  has(csv_error("0,0\n0.1,0\n0.2,0\n0.1,0.1\n0.1,0\n0,-0.1\n"), "crosses or touches itself");
  has(csv_error("0,0\n0.1,0\n0.05,0\n0.05,0.1\n"), "folds back onto itself at vertex 1");
  has(csv_error("0,0\n0.1,0\n0.1,0.1\n0.000001,0.0\n"), "not closed, but its ends all but meet (1.0");
  has(csv_error("0,0\n1e31,0\n0,1\n"), "vertex 1 is not a finite place");
  const auto header = parse_polygon_csv("x,y\n0,0\n", "p.csv");
  REQUIRE_FALSE(header);
  has(header.error().message(), "p.csv:1: the header is \"x,y\": x_m is missing; write the columns x_m,y_m");
  const auto turned = parse_polygon_csv("note,y_m,x_m\na,0,0\nb,0,0.1\nc,0.2,0.1\n", "p.csv");
  REQUIRE(turned);
  CHECK(turned->vertices == std::vector<Vec2>{{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.2}});
  const auto empty = parse_polygon_csv("x_m,y_m\n", "p.csv");
  REQUIRE_FALSE(empty);
  has(obj_error("v 0 0 0\nv 1 0 0\nv 1 1 0\n"), "no polyline");
  has(obj_error("v 0 0 0\nv 1 0 0\nl 1 3\n"), "p.obj:3: the polyline names vertex \"3\"");
  has(obj_error("v 0 0 0\nv 1 0 1\nv 1 1 0\nl 1 2 3\n"), "not flat");
  has(obj_error("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 2 0\nv 3 2 0\nl 1 2 3\nl 4 5\n"), "a second polyline");
}

TEST_CASE("a closed polygon whose closing segment crosses is refused") {
  has(csv_error("0,0\n0.1,0\n0.1,0.1\n0.05,-0.05\n0,0\n"), "crosses or touches itself");
}

TEST_CASE("files: .csv and .obj with lines alone are 2D, and what is written reads back bit for bit") {
  const testing::TempFolder folder;
  const PlanarPolygon arc = make_paper_arc(5);
  const auto path = folder.path() / "arc.csv";
  REQUIRE(write_polygon(arc, path));
  CHECK(is_planar_file(path));
  const auto back = read_polygon(path, 1e-3);
  REQUIRE(back);
  CHECK(back->vertices == arc.vertices);
  CHECK_FALSE(back->closed);
  const PlanarPolygon round = make_regular_polygon(7, 0.03);
  REQUIRE(write_polygon(round, path));
  const auto closed = read_polygon(path, 1e-3);
  REQUIRE(closed);
  CHECK(closed->closed);
  CHECK(closed->vertices == round.vertices);
  for (const double unit : {1.0, 1e-3}) {
    const auto obj = folder.path() / "round.obj";
    REQUIRE(write_polygon(round, obj, unit));
    CHECK(is_planar_file(obj));
    const auto read = read_polygon(obj, unit);
    REQUIRE(read);
    CHECK(read->closed);
    REQUIRE(read->vertices.size() == 7);
    for (std::size_t i = 0; i < 7; ++i) CHECK(glm::length(read->vertices[i] - round.vertices[i]) < 1e-16);
  }
  folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\n");
  folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n");
  CHECK_FALSE(is_planar_file(folder.path() / "mesh.obj"));
  CHECK(is_planar_file(folder.path() / "line.obj"));
  CHECK_FALSE(is_planar_file(folder.path() / "missing.obj"));
}

TEST_CASE("the paper's arc: facets touch it at their midpoints, or stand on it with their ends") {
  const PlanarPolygon tangent_arc = make_paper_arc(5, ArcPlacement::tangent, 0);
  CHECK(tangent_arc.vertices.size() == 6);
  for (std::size_t i = 0; i < 5; ++i)
    CHECK(glm::length(0.5 * (tangent_arc.vertices[i] + tangent_arc.vertices[i + 1])) ==
          approx(kPaperArcRadius).epsilon(1e-14));
  for (const Vec2& v : make_paper_arc(5, ArcPlacement::inscribed, 1).vertices)
    CHECK(glm::length(v) == approx(kPaperArcRadius).epsilon(1e-14));
  CHECK(kPaperArcRadius == 0.100);
  CHECK(kPaperArcRad * kPaperArcRadius == approx(0.0902));  // the paper: approximately 90 mm of travel
  // The paper: 16.3 segments are 3.38 degrees, 15.6 are 3.54.
  CHECK(kPaperArcRad / 15.3 * 180.0 / 3.14159265358979 == approx(3.38).epsilon(2e-3));
  CHECK(facet_turn_rad(16, ArcPlacement::tangent) == approx(kPaperArcRad / 15));
}
