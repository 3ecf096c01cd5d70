// workbench audit, run as a process.
#include "tests/support/approx.h"
#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

using namespace tangent::testing;
using tangent::test::approx;

TEST_CASE("a closed sphere is found healthy, in text and JSON") {
  const TempFolder folder;
  const std::string mesh = folder.file("sphere.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
  const ProcessResult result = run_workbench({"audit", mesh, "--json", folder.file("audit.json")});
  REQUIRE(result.exit_code == 0);
  CHECK(contains(result.out, "no defects found\n"));
  const auto audit = nlohmann::json::parse(read_text(folder.file("audit.json")));
  CHECK(audit["triangles"] == 320);
  CHECK(audit["edges"] == 480);
  CHECK(audit["vertices"] == 162);
  CHECK(audit["boundary_edges"] == 0);
  CHECK(audit["components"] == 1);
  CHECK(audit["defects"].empty());
  CHECK(audit["box_max_m"][0].get<double>() == approx(0.040).epsilon(1e-9));
  CHECK(audit["smoothness"]["conditions"]["P1"]["felt_edges"] == 0);
  CHECK(audit["smoothness"]["conditions"]["C3"]["felt_share"].get<double>() == 1.0);
  CHECK(audit["smoothness"]["condition"] == "C3");
}

TEST_CASE("a mesh that is used as it is has no defects but for what is noted") {
  const TempFolder folder;
  const std::string sheet = folder.write("sheet.obj", "v 0 0 0\nv 40 0 0\nv 40 40 0\nv 0 40 0\nf 1 2 3\nf 1 3 4\n");
  CHECK(contains(run_workbench({"audit", sheet}).out, "no defects found; noted above: boundary loops 1\n"));
  const std::string cylinder = folder.file("cylinder.obj");
  REQUIRE(run_workbench({"make", "cylinder", "--segments", "2000", "--out", cylinder}).exit_code == 0);
  CHECK(contains(run_workbench({"audit", cylinder}).out, "no defects found; noted above: slivers 8000\n"));
}

TEST_CASE("what can't be used is counted and named by index, and the work goes on") {
  const TempFolder folder;
  const std::string mesh = folder.write("odd.obj",
                                        "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\nv 5 5 5\n"
                                        "f 1 2 3\nf 1 1 2\nf 1 2 3\nf 1 2\nf 1 4 2\n");
  const ProcessResult result = run_workbench({"audit", mesh, "--json", folder.file("audit.json")});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const auto defects = nlohmann::json::parse(read_text(folder.file("audit.json")))["defects"];
  const auto first_of = [&](const char* word) -> std::int64_t {
    for (const auto& [name, list] : defects.items()) {
      if (contains(name, word) && list["count"] == 1) return list["first"][0].get<std::int64_t>();
    }
    return -1;
  };
  CHECK(first_of("degenerate") == 1);
  CHECK(first_of("duplicate") == 2);
  CHECK(first_of("corners") == 3);  // the 2-gon is face 3; it has no triangle
  CHECK(first_of("unreferenced") == 4);
  CHECK(contains(result.out, "found and dealt with"));
}

TEST_CASE("units, fit and normals reach the mesh, and an ignored option is noted") {
  const TempFolder folder;
  const std::string mesh = folder.file("sphere.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh, "--unit", "in"}).exit_code == 0);
  const auto audit = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"audit", mesh, "--json", folder.file("audit.json")});
    REQUIRE(run_workbench(more).exit_code == 0);
    return nlohmann::json::parse(read_text(folder.file("audit.json")));
  };
  CHECK(audit({"--unit", "in"})["box_max_m"][1].get<double>() == approx(0.040).epsilon(1e-9));
  CHECK(audit({"--fit-mm", "250"})["box_max_m"][1].get<double>() == approx(0.125).epsilon(1e-9));
  CHECK(audit({"--normals", "computed"})["mesh"]["normals_used"] == "computed");
  const auto noted = audit({"--normals", "file", "--crease-deg", "10"});
  CHECK(noted["mesh"]["normals_used"] == "file");
  CHECK(contains(noted["notes"].dump(), "--crease-deg"));
}

TEST_CASE("meshes that hold nothing usable are refused with the file and the line") {
  const TempFolder folder;
  const auto refused = [&](const std::string& name, const std::string& contents, const std::string& message) {
    CAPTURE(name);
    const ProcessResult result =
        run_workbench({"audit", folder.write(name, contents), "--json", folder.file("audit.json")});
    CAPTURE(result.err);
    CHECK(result.exit_code == 1);
    CHECK(contains(result.err, name));
    CHECK(contains(result.err, message));
    CHECK_FALSE(std::filesystem::exists(folder.file("audit.json")));
  };
  refused("empty.obj", "", "empty");
  refused("points.obj", "v 0 0 0\nv 1 0 0\n", "no faces");
  refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n", "index.obj:5");
  refused("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "usable");
  refused("hollow.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "usable");
  refused("format.xyz", "0 0 0\n", "format");
  refused("promise.ply",
          "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\n"
          "property float y\nproperty float z\nend_header\n1234",
          "promise.ply");
}

TEST_CASE("a closed mesh that is inside out is said by audit and solve, and turned over on request") {
  const TempFolder folder;
  const std::string mesh = folder.write("inside.obj",
                                        "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\n"
                                        "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const ProcessResult found = run_workbench({"audit", mesh, "--json", folder.file("audit.json")});
  REQUIRE(found.exit_code == 0);
  CHECK(contains(found.out, "inside out               4 triangles\n"));
  CHECK(contains(found.out, "note: the mesh is inside out (closed, with a volume of -3.6e+04 mm3)"));
  const auto audit = nlohmann::json::parse(read_text(folder.file("audit.json")));
  CHECK(audit["inside_out"]["triangles"] == 4);
  CHECK(audit["inside_out"]["turned_over"] == false);
  const ProcessResult turned = run_workbench({"audit", mesh, "--turn-over"});
  CHECK(contains(turned.out, "inside out               4 triangles, turned over\n"));

  // A finger of 5 mm, 1 mm deep in the face below.
  const std::string poses = folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0.015,0.015,-0.004\n");
  const auto penetration = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"solve",
                                       mesh,
                                       "--poses",
                                       poses,
                                       "--out",
                                       folder.file("ticks.csv"),
                                       "--summary",
                                       folder.file("s.json"),
                                       "--finger-radius-mm",
                                       "5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = run_workbench(arguments);
    REQUIRE(result.exit_code == 0);
    CHECK(contains(result.out, more.empty() ? "--turn-over turns it over" : ": turned over"));
    const std::string ticks = read_text(folder.file("ticks.csv"));
    std::string row = ticks.substr(ticks.find('\n') + 1);
    for (int i = 0; i < 12; ++i) row = row.substr(row.find(',') + 1);
    return std::strtod(row.c_str(), nullptr);
  };
  CHECK(penetration({}) == approx(0.009));
  CHECK(penetration({"--turn-over"}) == approx(0.001));
}

TEST_CASE("a mesh and a preset whose names are not UTF-8 are audited and solved, and the JSON stays JSON") {
  const TempFolder folder;
  const std::string mesh = folder.file("m\xE9sh.obj"), preset = folder.file("pr\xE9set.toml");
  REQUIRE(run_workbench({"make", "cube", "--out", mesh}).exit_code == 0);
  folder.write("pr\xE9set.toml", "[force]\nstiffness_n_per_m = 700\n");
  CHECK(run_workbench({"audit", mesh, "--json", folder.file("audit.json")}).exit_code == 0);
  const auto audit = nlohmann::json::parse(read_text(folder.file("audit.json")));
  CHECK(audit["mesh"]["name"] == "file:m%E9sh.obj");
  folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0,0,0.05\n");
  const ProcessResult solved = run_workbench({"solve", mesh, "--preset", preset, "--poses", folder.file("poses.csv"),
                                              "--out", folder.file("t.csv"), "--summary", folder.file("s.json")});
  CHECK(solved.exit_code == 0);
  CHECK(nlohmann::json::parse(read_text(folder.file("s.json")))["mesh"]["name"] == "file:m%E9sh.obj");
}
