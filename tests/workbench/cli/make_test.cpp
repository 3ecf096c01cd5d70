// workbench make, run as a process.
#include "core/io/polygon_io.h"
#include "core/lab/objects/arc.h"
#include "tests/support/approx.h"
#include "tests/support/process.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent::testing;
using tangent::test::approx;

TEST_CASE("every object can be made and read back without defects") {
  const TempFolder folder;
  for (const char* object : {"cone", "cylinder", "cube", "sphere", "tetrahedron", "octagon", "triangle", "hexagon",
                             "icosphere", "torus", "saddle", "groove"}) {
    CAPTURE(object);
    const std::string file = folder.file(std::string(object) + ".obj");
    const ProcessResult made = run_workbench({"make", object, "--out", file});
    CHECK(made.exit_code == 0);
    CHECK(contains(made.out, object));
    const ProcessResult audit = run_workbench({"audit", file});
    CHECK(audit.exit_code == 0);
    CHECK(contains(audit.out, "no defects found"));
  }
}

TEST_CASE("options shape the object") {
  const TempFolder folder;
  const auto made = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "make");
    arguments.insert(arguments.end(), {"--out", folder.file("o.obj")});
    REQUIRE(run_workbench(arguments).exit_code == 0);
    return read_text(folder.file("o.obj"));
  };
  CHECK(made({"cylinder", "--segments", "12"}).size() < made({"cylinder", "--segments", "48"}).size());
  CHECK(made({"cube"}).size() < made({"cube", "--rounding-mm", "1.5"}).size());
  CHECK(made({"cone", "--facing", "left"}) != made({"cone", "--facing", "right"}));
  CHECK(made({"cube", "--unit", "mm"}) != made({"cube", "--unit", "m"}));
}

TEST_CASE("the arc of the paper is 0.902 rad of a circle of 100 mm radius, in either format and placement") {
  const TempFolder folder;
  const auto arc = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {"make", "arc", "--out", folder.file(name)});
    const ProcessResult made = run_workbench(options);
    REQUIRE(made.exit_code == 0);
    CHECK(contains(made.out, "0.902 rad of a circle of 100 mm radius"));
    CHECK(tangent::is_planar_file(folder.file(name)));
    const auto polygon = tangent::read_polygon(folder.file(name), 1e-3);
    REQUIRE(polygon);
    return polygon->vertices;
  };
  const auto turn = [](const std::vector<tangent::Vec2>& v, std::size_t from, std::size_t to) {
    return std::atan2(v[from].x, v[from].y) - std::atan2(v[to].x, v[to].y);
  };
  const auto tangent_arc = arc("a.csv", {});
  REQUIRE(tangent_arc.size() == 8);  // five facets and one more at either end
  for (std::size_t i = 0; i + 1 < 8; ++i)
    CHECK(glm::length(0.5 * (tangent_arc[i] + tangent_arc[i + 1])) == approx(0.1).epsilon(1e-12));
  // From the middle of the first facet to that of the last.
  CHECK(-turn(tangent_arc, 1, 5) == approx(0.902).epsilon(1e-12));
  const auto inscribed = arc("b.obj", {"--segments", "9", "--placement", "inscribed"});
  REQUIRE(inscribed.size() == 12);
  for (const tangent::Vec2& v : inscribed) CHECK(glm::length(v) == approx(0.1).epsilon(1e-12));
  CHECK(-turn(inscribed, 1, 10) == approx(0.902).epsilon(1e-12));
  const auto in_metres = arc("c.obj", {"--unit", "m"});
  CHECK(in_metres[0].x == approx(1e-3 * tangent_arc[0].x).epsilon(1e-12));  // read as millimetres
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"arc", "--segments", "1"},
                                                {"arc", "--segments", "10001"},
                                                {"arc", "--rounding-mm", "1"},
                                                {"arc", "--exact", "--segments", "5"},
                                                {"cube", "--exact"},
                                                {"cube", "--placement", "tangent"}}) {
    std::vector<std::string> arguments{"make", "--out", folder.file("wrong.csv")};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    CHECK(run_workbench(arguments).exit_code == 2);
  }
  CHECK(folder.entry_count() == 3);
}

TEST_CASE("an exact arc comes back from its file as the circle that it is, and a CSV can't hold it") {
  const TempFolder folder;
  const std::string file = folder.file("exact.obj");
  CHECK(run_workbench({"make", "arc", "--exact", "--out", file}).exit_code == 0);
  const auto polygon = tangent::read_polygon(file, 1e-3);
  REQUIRE(polygon);
  REQUIRE(polygon->exact);
  const tangent::ExactArc expected = *tangent::ArcStimulus{}.exact().exact;
  CHECK(polygon->exact->radius_m == approx(expected.radius_m).epsilon(1e-15));
  CHECK(polygon->exact->half_angle_rad == expected.half_angle_rad);
  CHECK(polygon->exact->run_out_m == approx(expected.run_out_m).epsilon(1e-15));
  CHECK(polygon->vertices.size() >= 65);
  std::string text = read_text(file);
  text.replace(text.find("# exact arc: "), 13, "# exact arc: x");
  folder.write("broken.obj", text);
  const auto broken = tangent::read_polygon(folder.file("broken.obj"), 1e-3);
  REQUIRE_FALSE(broken);
  CHECK(contains(broken.error().where, ":2"));
  const ProcessResult csv = run_workbench({"make", "arc", "--exact", "--out", folder.file("exact.csv")});
  CHECK(csv.exit_code == 1);
  CHECK(contains(csv.err, "no exact arc"));
}

TEST_CASE("an object that does not exist is wrong usage and nothing is written") {
  const TempFolder folder;
  const ProcessResult result = run_workbench({"make", "teapot", "--out", folder.file("o.obj")});
  CHECK(result.exit_code == 2);
  CHECK(contains(result.err, "teapot"));
  CHECK(contains(result.err, "icosphere"));
  for (const auto& [option, value] : {std::pair("--segments", "0"),
                                      {"--segments", "-3"},
                                      {"--rounding-mm", "nan"},
                                      {"--rounding-mm", "-1"},
                                      {"--facing", "up"}}) {
    CAPTURE(option);
    CHECK(run_workbench({"make", "cube", "--out", folder.file("o.obj"), option, value}).exit_code == 2);
  }
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a file that can't be written leaves with 1") {
  const TempFolder folder;
  const ProcessResult result = run_workbench({"make", "cube", "--out", folder.file("no/folder/o.obj")});
  CHECK(result.exit_code == 1);
  CHECK(contains(result.err, folder.file("no/folder/o.obj")));
}

TEST_CASE("make refuses a name that says no format that it writes") {
  const TempFolder folder;
  for (const char* const object : {"cube", "arc"}) {
    for (const char* const name : {"a.toml", "a", "a.stl"}) {
      const ProcessResult refused = run_workbench({"make", object, "--out", folder.file(name)});
      CHECK(refused.exit_code == 2);
      CHECK(contains(refused.err, "names no format that is written; end it in .obj"));
    }
  }
  CHECK(run_workbench({"make", "cube", "--out", folder.file("a.csv")}).exit_code == 2);
  CHECK(folder.entry_count() == 0);
  CHECK(run_workbench({"make", "cube", "--out", folder.file("A.OBJ")}).exit_code == 0);
  CHECK(run_workbench({"make", "cube", "--out", "/dev/null"}).exit_code == 0);
}
