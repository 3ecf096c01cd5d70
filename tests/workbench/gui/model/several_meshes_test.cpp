// A recording in which the mesh was changed: what is in view is the mesh of the tick.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

/// Ticks 0 to 999 on a torus, from about 1,000 on a cube, then on the torus again.
void record_three(const std::string& path) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "torus";
  RunningApp ui(options);
  ui.model().record().start(path);
  for (const char* next : {"cube", "torus", ""}) {
    ui.run(1000);
    if (next[0] != '\0') ui.model().open(next);
  }
  ui.model().record().stop();
}

struct ThreeApp : RunningApp {
  explicit ThreeApp(const std::string& path) {
    model().open(path);
    frames(2);
    REQUIRE(model().time().recording() != nullptr);
  }
  std::string mesh_at(std::uint64_t tick) {
    model().time().select_tick(tick);
    frame();
    CHECK(model().scene().current() == model().time().scene_of_tick());
    return model().scene().current()->mesh().name();
  }
};

}  // namespace

TEST_CASE("the mesh in view, its map, its audit and Why go with the tick, and the servo keeps its own") {
  const testing::TempFolder folder;
  record_three(folder.file("three.sqlite"));
  ThreeApp ui(folder.file("three.sqlite"));
  const auto of_servo = ui.model().scene().of_servo();
  CHECK(ui.mesh_at(500) == "torus");
  ui.model().map().on = true;
  ui.frame();
  const std::size_t on_torus = ui.model().map().statistics().values;
  CHECK(on_torus > 0);
  const MeshAudit torus = *ui.model().scene().audit();
  CHECK(ui.mesh_at(1500) == "cube");
  ui.frame();
  CHECK(ui.model().map().statistics().values != on_torus);
  REQUIRE(ui.model().scene().audit() != nullptr);
  CHECK(ui.model().scene().audit()->triangles != torus.triangles);
  const Why* why = ui.model().why().of_tick_in_view();
  REQUIRE(why != nullptr);
  CHECK(why->asked.scene == ui.model().scene().current());
  ui.model().map().on = false;
  CHECK(ui.mesh_at(2500) == "torus");
  CHECK(ui.mesh_at(1300) == "cube");
  CHECK(ui.app().title().starts_with("cube"));
  CHECK(ui.model().scene().of_servo() == of_servo);
  CHECK(ui.model().devices().session()->scene() == of_servo);
  ui.key(HeadlessApp::kEnd);
  ui.frame();
  CHECK(ui.model().scene().current() == of_servo);
}

TEST_CASE("camera and picks stay while ticks are on one mesh, and another mesh is framed and has no picks") {
  const testing::TempFolder folder;
  record_three(folder.file("three.sqlite"));
  ThreeApp ui(folder.file("three.sqlite"));
  ui.mesh_at(300);
  ui.model().view().picked_triangle = 7;
  ui.model().view().isolate_marked();
  const std::uint64_t framings = ui.model().view().framings;
  ui.mesh_at(301);
  CHECK(ui.model().view().picked_triangle == 7);
  CHECK(ui.model().view().framings == framings);
  ui.mesh_at(1500);
  CHECK(ui.model().view().picked_triangle == kNone);
  CHECK(ui.model().view().isolation == nullptr);
  CHECK(ui.model().view().framings == framings + 1);
}

TEST_CASE("a mesh that is opened while a recording with several is looked at stays until the ticks' own changes") {
  const testing::TempFolder folder;
  record_three(folder.file("three.sqlite"));
  ThreeApp ui(folder.file("three.sqlite"));
  ui.mesh_at(1500);
  ui.model().open("icosphere");
  ui.frames(2);
  const auto opened = ui.model().scene().current();
  CHECK(opened->mesh().name() == "icosphere");
  CHECK(ui.model().devices().session()->scene() == opened);
  ui.model().time().select_tick(1501);
  ui.frame();
  CHECK(ui.model().scene().current() == opened);
  CHECK(ui.mesh_at(2500) == "torus");
  CHECK(ui.model().devices().session()->scene() == opened);
  // Devices that are chosen now get the servo's mesh, and a recording that begins now has it.
  ui.model().devices().choose({"none", ui.model().devices().names().display});
  CHECK(ui.model().devices().session()->scene() == opened);
  ui.model().record().start(folder.file("later.sqlite"));
  ui.app().advance(100);
  ui.frame();
  ui.model().record().stop();
  const auto later = OpenedRecording::open(folder.file("later.sqlite"), {});
  REQUIRE(later);
  CHECK((*later)->unsolvable().empty());
  CHECK((*later)->scene()->mesh().name() == "icosphere");
  ui.key(HeadlessApp::kEnd);
  ui.frame();
  CHECK(ui.model().scene().current() == opened);
}
