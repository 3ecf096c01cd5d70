// workbench audit, run as a process.
#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace tangent::testing;

TEST_CASE("a closed sphere is found healthy, in text and JSON") {
  const TempFolder folder;
  const std::string mesh = folder.file("sphere.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
  const ProcessResult result = run_workbench({"audit", mesh, "--json", folder.file("audit.json")});
  REQUIRE(result.exit_code == 0);
  CHECK(contains(result.out, "found nothing that can't be used"));
  const auto audit = nlohmann::json::parse(read_text(folder.file("audit.json")));
  CHECK(audit["triangles"] == 320);
  CHECK(audit["edges"] == 480);
  CHECK(audit["vertices"] == 162);
  CHECK(audit["boundary_edges"] == 0);
  CHECK(audit["components"] == 1);
  CHECK(audit["defects"].empty());
  CHECK(audit["box_max_m"][0].get<double>() == doctest::Approx(0.040).epsilon(1e-9));
  CHECK(audit["smoothness"]["conditions"]["P1"]["felt_edges"] == 0);
  CHECK(audit["smoothness"]["conditions"]["C3"]["felt_share"].get<double>() == 1.0);
  CHECK(audit["smoothness"]["condition"] == "C3");
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
  CHECK(audit({"--unit", "in"})["box_max_m"][1].get<double>() == doctest::Approx(0.040).epsilon(1e-9));
  CHECK(audit({"--fit-mm", "250"})["box_max_m"][1].get<double>() == doctest::Approx(0.125).epsilon(1e-9));
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
