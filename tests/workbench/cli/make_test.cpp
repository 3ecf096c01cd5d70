// workbench make, run as a process.
#include "tests/support/process.h"

#include <doctest/doctest.h>

using namespace tangent::testing;

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
    CHECK(contains(audit.out, "found nothing that can't be used"));
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
