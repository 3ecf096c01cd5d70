// The jobs of a tuner as the script that workbench/bench/README.md measures: find the worst place of a strange mesh,
// say why, cure it, prove it, keep it. Here on a coarser one.
#include "core/io/mesh_io.h"
#include "core/io/preset_file.h"
#include "core/lab/objects/generate.h"
#include "tests/support/paths.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

/// 320 triangles with edges of 3 mm, every vertex up to 0.3 mm off the sphere: the script's mesh, but a small one.
PolygonMesh noisy_sphere() {
  PolygonMesh mesh = make_icosphere(0.010, 2);
  mesh.normals.clear();
  mesh.corner_normal.clear();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] *= 1.0 + 0.03 * std::sin(12.9898 * static_cast<double>(i * i));
  return mesh;
}

/// Runs the script up to this line, as the window would; why it ended early, or nothing.
std::string run_part(HeadlessApp& ui, const testing::TempFolder& folder, const std::string& lines) {
  ui.app().run_script(folder.write("part.txt", lines));
  for (int i = 0; i < 4000 && ui.app().script_running() && ui.app().script_failure().empty(); ++i) {
    ui.frame();
    ui.model().exports().take_picture_request();  // nothing is drawn here
  }
  return ui.app().script_failure();
}

}  // namespace

TEST_CASE("the worst place of a strange mesh is found, explained, cured, and the cure proved and kept, by script" *
          doctest::skip(testing::kSanitized)) {
  const testing::TempFolder folder;
  const auto mesh = folder.path() / "noisy.obj";
  REQUIRE(write_obj(noisy_sphere(), mesh, 1e-3));
  std::ifstream file(testing::source_folder() + "/workbench/bench/tuner_jobs.txt");
  std::stringstream text;
  text << file.rdbuf();
  std::string lines = text.str();
  const auto replace = [&](const std::string& what, const std::string& by) {
    const std::size_t at = lines.find(what);
    REQUIRE(at != std::string::npos);
    lines.replace(at, what.size(), by);
  };
  replace("mesh noisy_sphere", "open " + mesh.string());
  replace("run 3000", "run 1000");
  const std::size_t cure = lines.find("# 3."), prove = lines.find("# 4.");
  AppOptions options = HeadlessApp::deterministic_options();
  options.preset_folder = folder.path() / "presets";
  HeadlessApp ui(options, 1600.0f, 1000.0f);

  REQUIRE(run_part(ui, folder, lines.substr(0, cure)) == "");
  const double planes_before = ui.model().map().statistics().mean;
  REQUIRE(ui.model().time().tick().record() != nullptr);
  const TickOutput worst = ui.model().time().tick().record()->tick.output;
  CHECK(worst.iterations > 20);
  const std::uint32_t place = ui.model().view().picked_triangle;

  REQUIRE(run_part(ui, folder, lines.substr(cure, prove - cure)) == "");
  CHECK(ui.model().view().picked_triangle == place);
  const TickOutput cured = ui.model().time().tick().record()->tick.output;
  CHECK(is_converged(cured.status));
  CHECK(cured.iterations < worst.iterations / 4);

  REQUIRE(run_part(ui, folder, lines.substr(prove)) == "");
  CHECK(ui.model().map().statistics().mean < planes_before / 2);
  const auto kept = read_preset(options.preset_folder / "tuned for noise.toml");
  REQUIRE(kept);
  CHECK(kept->preset.solver.method == Method::robust);
  CHECK(kept->about.note.find("noisy sphere cured") != std::string::npos);
}
